"""The whole service under faults: its processes are killed by real signals, and it is asked for too much."""

import asyncio
import signal
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import httpx
import psutil
import pytest

from faults.soak import scale
from nacreous.engine.sweep import Sweep
from nacreous.engine.work import compute
from served import Served, serving

TABLES = scale(40, 500)
KILLS = scale(2, 20)
OVERLOAD, QUEUE = scale(40, 400), 4
PATIENCE_S = 600.0


def spec(thickness_nm: float, size: int = 64) -> dict[str, Any]:
    """Return the spec of a film on glass, another table for another thickness."""
    layer = {"material": {"n": 2.0}, "thickness_nm": thickness_nm}
    table = {"cos_theta": size, "thickness_scale": {"start": 0.5, "stop": 1.5, "count": size}}
    return {"stack": {"incident": "air", "substrate": {"n": 1.5}, "layers": [layer]}, "table": table}


def sweep(tables: int) -> dict[str, Any]:
    """Return a sweep of so many small tables."""
    axis = {"start": 100.0, "stop": 800.0, "count": tables}
    return {"base": spec(420, 8), "formats": ["exr"], "vary": {"stack.layers.0.thickness_nm": axis}}


def worker_of(served: Served) -> psutil.Process | None:
    """Return the worker process of a service; None while it is being replaced."""
    children = psutil.Process(served.process.pid).children()
    return next((child for child in children if "nacreous.engine.worker" in child.cmdline()), None)


def kill_worker(served: Served) -> None:
    """End the worker as the system would."""
    if (worker := worker_of(served)) is not None:
        worker.kill()


@pytest.mark.parametrize("round_number", range(KILLS))
def test_a_killed_worker_costs_a_moment(tmp_path: Path, round_number: int) -> None:
    """SIGKILL in mid-kernel: the answer is a table or 503 to try again within 3 s, and then there is one."""

    async def killed(served: Served) -> None:
        async with httpx.AsyncClient(base_url=served.url, timeout=PATIENCE_S) as client:
            asked = asyncio.create_task(client.post("/v1/tables", json=spec(1000 + round_number, 320)))
            await _busy(client)
            kill_worker(served)
            answer = await asked
            assert answer.status_code in {201, 503}
            if answer.status_code == 503:
                assert int(answer.headers["retry-after"]) <= 3
            assert (await client.post("/v1/tables", json=spec(100 + round_number))).status_code == 201
        assert served.process.poll() is None

    with serving(tmp_path / "store", synchronous_seconds=1000) as served:
        served.await_ready()
        asyncio.run(killed(served))


async def _busy(client: httpx.AsyncClient) -> None:
    """Wait until the worker has something in hand."""
    while "nacreous_engine_busy 1.0" not in (await client.get("/metrics")).text:
        await asyncio.sleep(0)


def test_a_killed_server_goes_on_with_its_job(tmp_path: Path) -> None:
    """SIGKILL in the middle of a job: the next process ends it, to the same bytes, and redoes one table."""
    store = tmp_path / "store"
    with serving(store) as served, httpx.Client(base_url=served.url, timeout=PATIENCE_S) as client:
        served.await_ready()
        job = client.post("/v1/jobs", json=sweep(TABLES)).json()
        url = f"/v1/jobs/{job['id']}"
        done = _await(client, url, TABLES // 3)["done"]
        served.stop(signal.SIGKILL)
    with serving(store) as served, httpx.Client(base_url=served.url, timeout=PATIENCE_S) as client:
        served.await_ready()
        ended = _await(client, url, TABLES)
        assert (ended["state"], ended["done"], ended["failures"]) == ("done", TABLES, [])
        computed = _figure(client, "nacreous_engine_computed_total")
        assert computed <= TABLES - done + 1
        for index in range(0, TABLES, scale(13, 1)):
            (work,) = Sweep.from_document(sweep(TABLES))[index]
            (expected, *_) = compute(work).files
            assert client.get(f"/v1/tables/{work.id}.exr").content == expected.payload


def _await(client: httpx.Client, url: str, done: int) -> dict[str, Any]:
    end = time.monotonic() + PATIENCE_S
    while True:
        job: dict[str, Any] = client.get(url).json()
        if job["done"] >= done and (done < job["total"] or job["state"] == "done"):
            return job
        assert job["state"] in {"queued", "running"}, job
        assert time.monotonic() < end, job


def _figure(client: httpx.Client, name: str) -> float:
    lines = client.get("/metrics").text.splitlines()
    return float(next(line.split()[1] for line in lines if line.startswith(f"{name} ")))


def test_too_much_at_once_is_refused_and_the_rest_is_done(tmp_path: Path) -> None:
    """The queue is bounded: 429 says when to come again, and every table that was taken is answered."""

    async def asked(served: Served) -> Sequence[httpx.Response]:
        limits = httpx.Limits(max_connections=OVERLOAD)
        async with httpx.AsyncClient(base_url=served.url, timeout=PATIENCE_S, limits=limits) as client:
            posts = (client.post("/v1/tables", json=spec(100 + number)) for number in range(OVERLOAD))
            return await asyncio.gather(*posts)

    with serving(tmp_path / "store", queue_length=QUEUE, concurrency=2 * OVERLOAD) as served:
        served.await_ready()
        answers = asyncio.run(asked(served))
        taken = [answer for answer in answers if answer.status_code == 201]
        refused = [answer for answer in answers if answer.status_code == 429]
        assert len(taken) + len(refused) == OVERLOAD
        assert len(taken) > QUEUE
        assert refused
        assert all(int(answer.headers["retry-after"]) >= 1 for answer in refused)
        assert all(answer.headers["content-type"] == "application/problem+json" for answer in refused)
        with httpx.Client(base_url=served.url, timeout=PATIENCE_S) as client:
            assert _figure(client, "nacreous_engine_computed_total") == len(taken)
            for answer in taken:
                assert client.get(answer.json()["links"]["exr"]).status_code == 200
