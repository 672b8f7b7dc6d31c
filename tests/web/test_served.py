"""What needs a real process and real sockets: curl, signals, slow clients and too many of them."""

import asyncio
import json
import os
import shutil
import socket
import subprocess
import threading
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import httpx
import pytest

from served import PROGRAM, Served, serving

SLOW_SECONDS = 1


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    """Return a service that has little patience."""
    folder = tmp_path_factory.mktemp("served")
    with serving(
        folder / "store", header_seconds=SLOW_SECONDS, body_seconds=SLOW_SECONDS, max_header=8192
    ) as running:
        running.await_ready()
        yield running


def curl(*arguments: str) -> subprocess.CompletedProcess[bytes]:
    """Run curl, which sees an answer as users do."""
    program = shutil.which("curl")
    if program is None:
        pytest.skip("needs the package curl")
    return subprocess.run([program, "--silent", *arguments], capture_output=True, check=False)


def exchange(served: Served, sent: bytes) -> bytes:
    """Send bytes as they are, and return all that comes until the service closes."""
    with socket.create_connection(served.address, timeout=30) as connection:
        connection.sendall(sent)
        return until_closed(connection)


def trickle(served: Served, head: bytes) -> bytes:
    """Send a byte whenever a tenth of a second has passed without an answer, until the service closes."""
    received = b""
    with socket.create_connection(served.address, timeout=0.1) as connection:
        connection.sendall(head)
        for _ in range(100):
            try:
                chunk = connection.recv(65536)
                if not chunk:
                    return received
                received += chunk
            except TimeoutError:
                connection.sendall(b"x")
            except ConnectionResetError:
                return received
    raise AssertionError(f"the service still listens, and has said {received[:200]!r}")


def until_closed(connection: socket.socket) -> bytes:
    """Return all that comes; a reset is an end as well."""
    received = b""
    try:
        while chunk := connection.recv(65536):
            received += chunk
    except ConnectionResetError:
        pass
    return received


def test_curl_goes_on_where_it_was(served: Served, tmp_path: Path) -> None:
    """HEAD, a range, a resumed download and 304, by curl."""
    url = f"{served.url}/v1/presets/coated-lens.exr"
    whole, part, rest = tmp_path / "whole", tmp_path / "part", tmp_path / "rest"
    assert curl("--fail", "-o", str(whole), url).returncode == 0
    head = curl("--head", url).stdout.decode()
    assert f"content-length: {whole.stat().st_size}" in head
    assert curl("--range", "0-99", "-o", str(part), url).returncode == 0
    assert part.read_bytes() == whole.read_bytes()[:100]
    rest.write_bytes(part.read_bytes())
    assert curl("--continue-at", "-", "-o", str(rest), url).returncode == 0
    assert rest.read_bytes() == whole.read_bytes()
    tag = next(line[6:] for line in head.splitlines() if line.startswith("etag: "))
    status = curl("--header", f"If-None-Match: {tag}", "-o", str(part), "--write-out", "%{http_code}", url)
    assert status.stdout == b"304"


def test_a_body_that_trickles_is_given_up(served: Served) -> None:
    """408 once the time is over, and the connection is closed: it is not held by a byte now and then."""
    answer = trickle(
        served,
        b"POST /v1/tables HTTP/1.1\r\nHost: n\r\nContent-Type: application/json\r\n"
        b"Content-Length: 1000\r\n\r\n",
    )
    assert answer.startswith(b"HTTP/1.1 408 ")
    assert b"application/problem+json" in answer


def test_a_header_that_trickles_is_given_up(served: Served) -> None:
    """408 for a header that never ends, also where nothing has been sent at all."""
    assert exchange(served, b"").startswith(b"HTTP/1.1 408 ")
    assert trickle(served, b"GET /healthz HTTP/1.1\r\nHost: n\r\nX-Slow: ").startswith(b"HTTP/1.1 408 ")


def test_a_trickling_body_that_nobody_reads_is_given_up(served: Served) -> None:
    """A 404 before the body has come ends the connection."""
    answer = trickle(served, b"POST /nothing HTTP/1.1\r\nHost: n\r\nContent-Length: 1000\r\n\r\n")
    assert answer.startswith(b"HTTP/1.1 404 ")


@pytest.mark.parametrize("complete", [True, False])
def test_64_kb_of_header_are_refused(served: Served, complete: bool) -> None:  # noqa: FBT001 - parametrised
    """431, whether the header ends or not, and before it is kept."""
    header = (
        b"GET /healthz HTTP/1.1\r\nHost: n\r\nX-Long: " + b"x" * 65536 + (b"\r\n\r\n" if complete else b"")
    )
    answer = exchange(served, header.replace(b"healthz", b"v1/presets"))
    assert answer.startswith(b"HTTP/1.1 431 ")
    assert b"application/problem+json" in answer


@pytest.mark.parametrize(
    "sent",
    [b"\x16\x03\x01\x02\x00\x01\x00\r\n\r\n", b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"\x00" * 100],
)
def test_what_is_no_http_is_refused(served: Served, sent: bytes) -> None:
    """400 as a problem, and an end."""
    answer = exchange(served, sent)
    assert answer.startswith(b"HTTP/1.1 400 ")
    assert b"application/problem+json" in answer


def test_too_large_a_body_hears_so(served: Served) -> None:
    """413 reaches who declares it, who sends it in chunks, and who asks before (Expect: 100-continue)."""
    large = b" " * (3 * 2**20)
    headers = {"content-type": "application/json"}
    with httpx.Client(base_url=served.url) as client:
        assert client.post("/v1/tables", content=large, headers=headers).status_code == 413
        chunks = (large[:65536] for _ in range(64))
        assert client.post("/v1/tables", content=chunks, headers=headers).status_code == 413
    asked = exchange(
        served,
        b"POST /v1/tables HTTP/1.1\r\nHost: n\r\nContent-Type: application/json\r\nExpect: 100-continue\r\n"
        b"Content-Length: 3000000\r\n\r\n",
    )
    assert b"HTTP/1.1 413 " in asked


def test_200_slow_connections_are_in_nobody_s_way(served: Served) -> None:
    """While they hang, a probe is answered; when their time is over, they are closed."""
    slow = [socket.create_connection(served.address, timeout=30) for _ in range(200)]
    try:
        for connection in slow:
            connection.sendall(b"POST /v1/tables HTTP/1.1\r\n")
        assert httpx.get(f"{served.url}/healthz").status_code == 200
        assert all(until_closed(connection).startswith(b"HTTP/1.1 408 ") for connection in slow)
    finally:
        for connection in slow:
            connection.close()


def test_too_many_connections_are_turned_away(tmp_path: Path) -> None:
    """The one that is too many hears 503; when another has gone, the next is answered."""
    with serving(tmp_path / "store", connections=3) as few:
        held = [socket.create_connection(few.address, timeout=30) for _ in range(3)]
        assert exchange(few, b"").startswith(b"HTTP/1.1 503 ")
        held.pop().close()
        assert httpx.get(f"{few.url}/healthz").status_code == 200
        for connection in held:
            connection.close()


def test_requests_beyond_the_limit_hear_503(tmp_path: Path) -> None:
    """One request is held by its own body; the next hears when to come again, and probes are answered."""
    with serving(tmp_path / "store", concurrency=1) as one, httpx.Client(base_url=one.url) as client:
        with socket.create_connection(one.address, timeout=30) as holding:
            holding.sendall(
                b"POST /v1/tables HTTP/1.1\r\nHost: n\r\nContent-Type: application/json\r\n"
                b"Content-Length: 10\r\n\r\n"
            )
            refused = _eventually(client, "/v1/presets", 503)
            assert refused.headers["retry-after"] == "1"
            assert client.get("/healthz").status_code == 200
        assert _eventually(client, "/v1/presets", 200)


def _eventually(client: httpx.Client, path: str, status: int) -> httpx.Response:
    end = time.monotonic() + 30
    while (answer := client.get(path)).status_code != status:
        assert time.monotonic() < end, answer.text
    return answer


def test_sigterm_finishes_what_runs(tmp_path: Path, film: Mapping[str, Any]) -> None:
    """/readyz says 503 at once, what runs is answered in full, what comes is refused; exit code 0."""
    spec = {**film, "table": {"cos_theta": 700, "thickness_scale": {"start": 0.1, "stop": 9, "count": 700}}}
    with serving(tmp_path / "store", synchronous_seconds=60) as running:
        running.await_ready()
        answers: list[httpx.Response] = []

        def ask() -> None:
            answers.append(httpx.post(f"{running.url}/v1/tables", json=spec, timeout=60))

        with httpx.Client(base_url=running.url) as probe:
            probe.get("/readyz")
            asking = threading.Thread(target=ask)
            asking.start()
            _await_busy(probe)
            running.process.terminate()
            stopping = _eventually(probe, "/readyz", 503)
            assert "stopping" in stopping.json()["detail"]
            assert probe.get("/v1/presets").status_code == 503
            began = time.monotonic()
        assert running.process.wait(20) == 0
        assert time.monotonic() - began < 20
        asking.join()
    (answer,) = answers
    assert answer.status_code == 201
    assert len(answer.json()["id"]) == 64


def _await_busy(client: httpx.Client) -> None:
    end = time.monotonic() + 30
    while "nacreous_engine_busy 1.0" not in client.get("/metrics").text:
        assert time.monotonic() < end


def test_events_end_with_the_service(tmp_path: Path, film: Mapping[str, Any]) -> None:
    """Who follows a long job does not hold the service back; the job is still there when it is back."""
    vary = {"stack.layers.0.thickness_nm": {"start": 100, "stop": 900, "count": 3000}}
    with serving(tmp_path / "store") as running, httpx.Client(base_url=running.url, timeout=60) as client:
        running.await_ready()
        links = client.post("/v1/jobs", json={"base": film, "vary": vary}).json()["links"]
        with client.stream("GET", links["events"]) as events:
            lines = events.iter_lines()
            assert next(lines) == "event: progress"
            running.process.terminate()
            assert list(lines)[-1] == ""
        assert running.process.wait(20) == 0
    with serving(tmp_path / "store") as again, httpx.Client(base_url=again.url, timeout=60) as client:
        assert client.get(links["self"]).json()["state"] in {"queued", "running"}
        assert client.request("DELETE", links["self"]).json()["state"] == "cancelled"


def test_a_misspelt_setting_is_named_in_the_log(tmp_path: Path) -> None:
    """The service runs, and a warning has the variable and the one that was meant, never what it holds."""
    with serving(tmp_path / "store", deadline_second="hush") as running:
        assert running.url
        lines = [json.loads(line) for line in running.lines]
    (warning,) = [line for line in lines if line["event"] == "unknown setting"]
    assert warning["level"] == "warning"
    assert warning["variable"] == "NACREOUS_DEADLINE_SECOND"
    assert warning["remedy"] == "did you mean NACREOUS_DEADLINE_SECONDS?"
    assert "hush" not in running.log.read_text()


def test_keys_that_are_refused_are_not_shown() -> None:
    """A key beside a wrong one is still a secret, and stderr is kept in journals."""
    environment = {**os.environ, "NACREOUS_API_KEYS": "averygoodlongsecretkey1234,short"}
    program = [*PROGRAM, "serve"]
    done = subprocess.run(program, env=environment, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 2
    assert "NACREOUS_API_KEYS" in done.stderr
    assert "secret" not in done.stderr


def test_sigterm_refuses_what_waits(tmp_path: Path, film: Mapping[str, Any]) -> None:
    """A table that has not been begun is told to come again: 503, no half-made answer, and exit code 0."""
    specs = [
        {
            **film,
            "table": {"cos_theta": 600 + number, "thickness_scale": {"start": 0.1, "stop": 9, "count": 600}},
        }
        for number in range(6)
    ]

    async def asked(running: Served) -> list[httpx.Response]:
        async with httpx.AsyncClient(base_url=running.url, timeout=60) as client:
            posts = [asyncio.create_task(client.post("/v1/tables", json=spec)) for spec in specs]
            while "nacreous_engine_queued 5.0" not in (await client.get("/metrics")).text:
                await asyncio.sleep(0)
            running.process.terminate()
            return await asyncio.gather(*posts)

    with serving(tmp_path / "store", synchronous_seconds=60) as running:
        running.await_ready()
        answers = asyncio.run(asked(running))
        assert running.process.wait(20) == 0
    assert [answer.status_code for answer in answers].count(201) == 1
    refused = [answer for answer in answers if answer.status_code == 503]
    assert len(refused) == 5
    assert all(answer.headers["retry-after"] for answer in refused)
    assert "Traceback" not in running.log.read_text()


def test_a_client_that_goes_away_is_no_fault_of_the_service(served: Served) -> None:
    """A body that ends early is counted as 499, and logged as a request and nothing more."""
    with socket.create_connection(served.address) as client:
        client.sendall(b"POST /v1/tables HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n")
        client.sendall(b"Content-Length: 100\r\n\r\n{}")
    with httpx.Client(base_url=served.url) as probe:
        end = time.monotonic() + 30
        while 'route="/v1/tables",status="499"' not in probe.get("/metrics").text:
            assert time.monotonic() < end
    assert "ClientDisconnect" not in served.log.read_text()


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (("--port", "70000"), "--port"),
        (("--host", "256.256.256.256"), "nacreous: "),
        (("--host", "192.0.2.1"), "nacreous: "),
    ],
)
def test_a_wrong_option_is_told_in_one_message(arguments: tuple[str, str], named: str) -> None:
    """Exit code 2 or 1, no traceback."""
    program = [*PROGRAM, "serve", *arguments]
    done = subprocess.run(program, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode in {1, 2}
    assert "Traceback" not in done.stderr
    assert named in done.stderr
