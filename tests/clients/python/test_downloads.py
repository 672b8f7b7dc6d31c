"""Downloads that are cut, wrong, damaged, killed, or two at once."""

import asyncio
import hashlib
import subprocess
import sys
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from nacreous_client import (
    AnswerError,
    AsyncClient,
    ChecksumError,
    Client,
    Retry,
    UnreachableError,
)

from answering_server import (
    Answer,
    AnsweringServer,
    Asked,
    file_answer,
    json_answer,
)

Call = Callable[..., Any]

ID = "a1" * 32
FILE = bytes(range(256)) * 700
EXR = f"GET /v1/tables/{ID}.exr"


def test_a_download_that_is_cut_goes_on_where_it_was(
    server: AnsweringServer, call: Call, tmp_path: Path
) -> None:
    """Each request asks for the rest alone, if it is still the same file (RFC 9110, 13.1.5 and 14.2)."""
    server.script(EXR, file_answer(FILE, sent=50_000))
    told: list[tuple[int, int | None]] = []
    found = call(
        server.address, "download", ID, ".exr", tmp_path / "made" / "film.exr", lambda *at: told.append(at)
    )
    assert (tmp_path / "made" / "film.exr").read_bytes() == FILE
    assert (found.sha256, found.size_bytes) == (hashlib.sha256(FILE).hexdigest(), len(FILE))
    assert [path.name for path in found.path.parent.iterdir()] == ["film.exr"]
    ranges = [asked.headers.get("range") for asked in server.calls(EXR)]
    assert ranges == [None, "bytes=50000-", "bytes=100000-", "bytes=150000-"]
    assert {asked.headers.get("if-range") for asked in server.calls(EXR)[1:]} == {f'"{found.sha256}"'}
    assert told == sorted(told)
    assert told[-1] == (len(FILE), len(FILE))


def test_a_later_call_goes_on_with_what_an_earlier_one_has_left(
    server: AnsweringServer, call: Call, tmp_path: Path
) -> None:
    """What has come is kept, hidden, where a call gives up; the file is not there until it is complete."""
    server.script(EXR, file_answer(FILE, sent=60_000), Answer(0), file_answer(FILE))
    with pytest.raises(UnreachableError, match="broke off"):
        call(server.address, "download", ID, ".exr", tmp_path / "film.exr", retry=Retry(attempts=1))
    (left,) = tmp_path.iterdir()
    assert left.name.startswith(".nacreous-")
    assert left.read_bytes() == FILE[:60_000]
    with pytest.raises(UnreachableError):
        call(server.address, "download", ID, ".exr", tmp_path / "film.exr", retry=Retry(attempts=1))
    call(server.address, "download", ID, ".exr", tmp_path / "film.exr")
    assert server.calls(EXR)[-1].headers["range"] == "bytes=60000-"
    assert [path.name for path in tmp_path.iterdir()] == ["film.exr"]
    assert (tmp_path / "film.exr").read_bytes() == FILE


def test_a_process_that_is_killed_leaves_what_has_come(server: AnsweringServer, tmp_path: Path) -> None:
    """SIGKILL runs no handler: what was written before it is gone on with."""
    arrived, hang = threading.Event(), threading.Event()

    def stall(asked: Asked) -> Answer:
        if "range" not in asked.headers:
            return file_answer(FILE, sent=100_000)(asked)
        arrived.set()
        hang.wait(60)
        return Answer(0)

    server.script(EXR, stall, stall, file_answer(FILE))
    script = f"import nacreous_client as n; n.Client({server.address!r}).download({ID!r}, '.exr', 'film.exr')"
    with subprocess.Popen([sys.executable, "-c", script], cwd=tmp_path) as child:
        assert arrived.wait(60)
        child.kill()
    hang.set()
    with Client(server.address) as service:
        service.download(ID, ".exr", tmp_path / "film.exr")
    assert server.calls(EXR)[-1].headers["range"] == "bytes=100000-"
    assert (tmp_path / "film.exr").read_bytes() == FILE


def test_another_file_than_the_one_begun_is_brought_whole(
    server: AnsweringServer, call: Call, tmp_path: Path
) -> None:
    """A new version of the service may change a preset, and its ETag: no byte of the old file is used."""
    other = FILE[::-1]
    server.script("GET /v1/presets/paper/figure-3.exr", file_answer(FILE, sent=1000), file_answer(other))
    call(server.address, "download", "paper/figure-3", ".exr", tmp_path / "film.exr")
    assert (tmp_path / "film.exr").read_bytes() == other
    assert [path.name for path in tmp_path.iterdir()] == ["film.exr"]


def test_wrong_bytes_are_asked_for_again(server: AnsweringServer, call: Call, tmp_path: Path) -> None:
    """One bit of difference is a different file, also where the length is right."""
    wrong = bytes([FILE[0] ^ 1]) + FILE[1:]
    server.script(EXR, file_answer(FILE, shown=wrong), file_answer(FILE))
    call(server.address, "download", ID, ".exr", tmp_path / "film.exr")
    assert (tmp_path / "film.exr").read_bytes() == FILE


def test_bytes_that_stay_wrong_are_refused(server: AnsweringServer, call: Call, tmp_path: Path) -> None:
    """Nothing is kept of them, and what was there before is as it was."""
    (tmp_path / "film.exr").write_bytes(b"before")
    server.script(EXR, file_answer(FILE, shown=FILE[1:]))
    with pytest.raises(ChecksumError, match="other bytes"):
        call(server.address, "download", ID, ".exr", tmp_path / "film.exr")
    assert len(server.calls(EXR)) == 3
    assert (tmp_path / "film.exr").read_bytes() == b"before"
    assert [path.name for path in tmp_path.iterdir()] == ["film.exr"]


def test_a_part_that_was_damaged_is_dropped(server: AnsweringServer, call: Call, tmp_path: Path) -> None:
    """A disk may lie, too: of what an earlier call has left, nothing is believed."""
    server.script(EXR, file_answer(FILE, sent=60_000), file_answer(FILE))
    with pytest.raises(UnreachableError):
        call(server.address, "download", ID, ".exr", tmp_path / "film.exr", retry=Retry(attempts=1))
    (left,) = tmp_path.iterdir()
    left.write_bytes(b"\0" * len(left.read_bytes()))
    call(server.address, "download", ID, ".exr", tmp_path / "film.exr")
    assert (tmp_path / "film.exr").read_bytes() == FILE


def test_a_part_that_is_longer_than_the_file_is_dropped(
    server: AnsweringServer, call: Call, tmp_path: Path
) -> None:
    """416: the range has no byte of the file (RFC 9110, 15.5.17)."""
    server.script(EXR, file_answer(FILE, sent=60_000), file_answer(FILE))
    with pytest.raises(UnreachableError):
        call(server.address, "download", ID, ".exr", tmp_path / "film.exr", retry=Retry(attempts=1))
    (left,) = tmp_path.iterdir()
    left.write_bytes(FILE + b"more")
    call(server.address, "download", ID, ".exr", tmp_path / "film.exr")
    assert (tmp_path / "film.exr").read_bytes() == FILE


@pytest.mark.parametrize(
    "headers",
    [
        {},
        {"ETag": 'W/"' + "0" * 64 + '"'},
        {"ETag": '"v1"'},
        {"ETag": '"' + "0" * 64 + '"', "Content-Encoding": "br"},
    ],
)
def test_a_file_without_a_checksum_is_refused(
    server: AnsweringServer, call: Call, tmp_path: Path, headers: dict[str, str]
) -> None:
    """No ETag, a weak one, or one of bytes that something in between has changed."""
    server.script(EXR, Answer(200, headers, b""))
    with pytest.raises(AnswerError, match="SHA-256"):
        call(server.address, "download", ID, ".exr", tmp_path / "film.exr")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("status", [204, 304])
def test_an_answer_without_a_file_is_refused(
    server: AnsweringServer, call: Call, tmp_path: Path, status: int
) -> None:
    """No body was asked to be left out (RFC 9110, 15.3.5 and 15.4.5): what has come before is kept."""
    server.script(EXR, file_answer(FILE, sent=1000), Answer(status))
    with pytest.raises(AnswerError, match=f"got an answer {status}"):
        call(server.address, "download", ID, ".exr", tmp_path / "film.exr")
    assert [path.stat().st_size for path in tmp_path.iterdir()] == [1000]


def test_two_at_once_do_not_write_into_one_another(server: AnsweringServer, tmp_path: Path) -> None:
    """Both are in the middle of the file at the same time: one of them writes a part of its own."""
    both = threading.Barrier(2)

    def together(asked: Asked) -> Answer:
        if "range" in asked.headers:
            both.wait(60)
        return file_answer(FILE, sent=90_000)(asked)

    server.script(EXR, together)
    with Client(server.address) as service, ThreadPoolExecutor() as threads:
        for done in [threads.submit(service.download, ID, ".exr", tmp_path / "film.exr") for _ in range(2)]:
            assert done.result().sha256 == hashlib.sha256(FILE).hexdigest()
    assert [asked.headers.get("range") for asked in server.calls(EXR)].count("bytes=90000-") == 2
    assert [path.name for path in tmp_path.iterdir()] == ["film.exr"]
    assert (tmp_path / "film.exr").read_bytes() == FILE


def test_awaited_calls_run_at_the_same_time(server: AnsweringServer) -> None:
    """Neither is answered before the other has been asked: one after the other would never end."""
    both = threading.Barrier(2)

    def together(_: object) -> Answer:
        both.wait(60)
        return json_answer({"presets": []})

    async def two() -> list[Any]:
        async with AsyncClient(server.address) as service:
            return await asyncio.gather(service.presets(), service.presets())

    server.script("GET /v1/presets", together)
    assert asyncio.run(two()) == [(), ()]
