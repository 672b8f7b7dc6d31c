"""Measure the service beside starlette alone, and print the ratios: `python -m load`, tests on the path."""

import asyncio
import itertools
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx

from load.requests import requests_per_second
from served import serving

ROUNDS, ROUND_SECONDS = 7, 0.8
COLD_TABLES, PROBES = 60, 400
QUEUE, CLIENTS, OVERLOAD_SECONDS = 16, 160, 8.0
PLAIN = [sys.executable, "-m", "load.plain_app"]


def film(thickness_nm: float, cos_theta: int = 64, scales: int = 64) -> dict[str, Any]:
    """Return the spec of a lookup table of a film on glass."""
    return {
        "stack": {
            "incident": "air",
            "substrate": {"n": 1.5},
            "layers": [{"material": {"n": 2.0}, "thickness_nm": thickness_nm}],
        },
        "table": {
            "cos_theta": cos_theta,
            "thickness_scale": {"start": 0.5, "stop": 1.5, "count": scales},
        },
    }


def main() -> None:
    """Measure and print."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        with serving(folder / "store") as served, httpx.Client(base_url=served.url, timeout=60) as client:
            served.await_ready()
            print_hot(client, folder)
            print_cold(client)
            print_probes(client, served.url)
        with serving(folder / "overloaded", queue_length=QUEUE) as served:
            served.await_ready()
            print_overload(served.url)


def print_hot(client: httpx.Client, folder: Path) -> None:
    """Compare a table in memory with the same bytes from starlette, in rounds that take turns."""
    answer = client.post("/v1/tables", json=film(420, cos_theta=128, scales=200))
    url = str(client.base_url.join(answer.json()["links"]["exr"]))
    file = client.get(url)
    (folder / "table.exr").write_bytes(file.content)
    known = {"If-None-Match": file.headers["etag"]}
    with plain_server(folder / "table.exr") as plain:
        runs: dict[str, Callable[[], float]] = {
            "service, hot": lambda: requests_per_second(url, ROUND_SECONDS, {}),
            "Response": lambda: requests_per_second(f"{plain}/response", ROUND_SECONDS, {}),
            "FileResponse": lambda: requests_per_second(f"{plain}/file", ROUND_SECONDS, {}),
            "service, 304": lambda: requests_per_second(url, ROUND_SECONDS, known, 304),
        }
        rates = in_turns(runs)
    print(f"a table of {len(file.content) / 1000:.0f} kB, requests a second:")
    for name, found in rates.items():
        print(f"  {name:16}{statistics.median(found):10.0f}")
    print(f"  hot / FileResponse  {ratio(rates, 'FileResponse'):.2f}   (target 1.5)")
    print(f"  hot / Response      {ratio(rates, 'Response'):.2f}   (target 0.8)", flush=True)


def in_turns(runs: Mapping[str, Callable[[], float]]) -> dict[str, list[float]]:
    """Return each run's results, one a round."""
    results: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(ROUNDS):
        for name, run in runs.items():
            results[name].append(run())
    return results


def ratio(rates: Mapping[str, list[float]], name: str) -> float:
    """Return the median of the hot service's rate to another's of the same round."""
    return statistics.median(
        ours / other for ours, other in zip(rates["service, hot"], rates[name], strict=True)
    )


@contextmanager
def plain_server(path: Path) -> Iterator[str]:
    """Run starlette alone, and yield where it listens."""
    process = subprocess.Popen([*PLAIN, str(path)], stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None
        yield process.stdout.readline().strip()
    finally:
        process.terminate()
        process.wait()


def print_cold(client: httpx.Client) -> None:
    """Time what nobody has asked for: the spec is sent, the table computed, stored, and its file fetched."""
    milliseconds = []
    for number in range(COLD_TABLES):
        began = time.perf_counter()
        answer = client.post("/v1/tables", json=film(100 + number))
        assert answer.status_code == 201, answer.text
        assert client.get(answer.json()["links"]["exr"]).status_code == 200
        milliseconds.append((time.perf_counter() - began) * 1e3)
    warm = sorted(milliseconds[5:])
    print(f"cold 64 x 64 fresnel table, end to end: p50 {statistics.median(warm):.1f} ms   (target 50)")
    print(f"  p90 {warm[int(len(warm) * 0.9)]:.1f} ms", flush=True)


def print_probes(client: httpx.Client, url: str) -> None:
    """Time /healthz while the worker always has something to do."""
    stop = threading.Event()

    def keep_busy() -> None:
        with httpx.Client(base_url=url, timeout=60) as own:
            number = 0
            while not stop.is_set():
                number += 1
                own.post("/v1/tables", json=film(1000 + number / 8, cos_theta=256, scales=256))

    busy = threading.Thread(target=keep_busy)
    busy.start()
    milliseconds = []
    for _ in range(PROBES):
        began = time.perf_counter()
        assert client.get("/healthz").status_code == 200
        milliseconds.append((time.perf_counter() - began) * 1e3)
    stop.set()
    busy.join()
    ordered = sorted(milliseconds)
    print(f"/healthz while the worker is busy: p50 {statistics.median(ordered):.1f} ms,", end=" ")
    print(f"p99 {ordered[int(len(ordered) * 0.99)]:.1f} ms   (target 100)")


def print_overload(url: str) -> None:
    """Compare what is answered when ten times as many ask as the queue holds with what one asks in a row."""
    alone, _ = asyncio.run(answered(url, 1, 500))
    goodput, refused = asyncio.run(answered(url, CLIENTS, 501))
    print(f"cold tables a second: one client {alone:.1f}, {CLIENTS} clients {goodput:.1f}", end=" ")
    print(f"with {refused:.0f} refusals a second: goodput {goodput / alone:.2f}   (target 0.8)")


async def answered(url: str, clients: int, first_nm: float) -> tuple[float, float]:
    """Return tables and refusals a second, for so many clients that ask again as soon as they are told to."""
    statuses: list[int] = []
    numbers = itertools.count()
    end = time.perf_counter() + OVERLOAD_SECONDS

    async def ask(client: httpx.AsyncClient) -> None:
        while time.perf_counter() < end:
            answer = await client.post("/v1/tables", json=film(first_nm + next(numbers) / 4096))
            statuses.append(answer.status_code)
            if answer.status_code == 429:
                await asyncio.sleep(float(answer.headers["retry-after"]))

    limits = httpx.Limits(max_connections=clients)
    async with httpx.AsyncClient(base_url=url, timeout=60, limits=limits) as client:
        await asyncio.gather(*(ask(client) for _ in range(clients)))
    return statuses.count(201) / OVERLOAD_SECONDS, statuses.count(429) / OVERLOAD_SECONDS


if __name__ == "__main__":
    main()
