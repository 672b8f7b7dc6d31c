"""A worker that is killed from outside: its supervisor lives, and nobody hears of it."""

import asyncio
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

from faults.soak import scale
from nacreous.engine.engine import Readiness
from nacreous.engine.work import compute
from nacreous.engine.worker_engine import WorkerEngine
from nacreous.errors import UnavailableError
from worker_engines import (
    at_first_progress,
    begun,
    faulty,
    film_work,
    long_work,
    patiently,
    running,
    until,
)

ORPHANED = """
import asyncio, sys
from worker_engines import faulty, film_work, running

async def main():
    async with running(faulty("endless")) as engine:
        await engine.compute(film_work())
        def at_work(_):
            print(engine.worker_pid, flush=True)
        await engine.compute(film_work(1001.0), at_work)

asyncio.run(main())
"""
"""A supervisor whose worker never ends what it is at; it says when, and which process it is."""


def kill(engine: WorkerEngine) -> int:
    """Kill the worker, and return its process id."""
    pid = engine.worker_pid
    assert pid is not None
    os.kill(pid, signal.SIGKILL)
    return pid


def test_a_request_survives_the_death_of_its_worker() -> None:
    """SIGKILL in mid-work: the work is done once more by the next worker, and so is the next request's."""
    kills = scale(2, 100)
    expected = compute(long_work()).files

    async def killed() -> None:
        async with running() as engine:
            for number in range(kills):
                product = await at_first_progress(engine, long_work(), lambda: kill(engine))
                assert product.files == expected
                assert engine.restarts == number + 1
                await engine.compute(film_work())
            assert engine.kernel_wipes == 0
            assert engine.computed == 2 * kills

    patiently(killed())


def test_an_idle_worker_that_dies_is_replaced_at_once() -> None:
    """The supervisor sees the death itself, and needs no request for it."""

    async def killed() -> None:
        async with running() as engine:
            await until(engine, Readiness.READY)
            for _ in range(2):
                dead = kill(engine)
                while engine.worker_pid in {dead, None}:
                    await asyncio.sleep(0.01)
                await until(engine, Readiness.READY)
            assert engine.restarts == 2
            assert (await engine.compute(film_work())).files

    patiently(killed())


def test_a_worker_that_dies_while_it_starts_is_started_again() -> None:
    """No request is lost over a worker that has not been ready."""

    async def killed() -> None:
        async with running() as engine:
            waiting = asyncio.create_task(engine.compute(film_work()))
            while not (children := psutil.Process().children()):
                await asyncio.sleep(0.01)
            children[0].kill()
            assert (await waiting).files
            assert engine.kernel_wipes == 0

    patiently(killed())


def test_an_orphaned_worker_ends() -> None:
    """A supervisor that is killed takes its worker along, in mid-kernel as well: none computes for nobody."""
    supervisor = subprocess.Popen(
        [sys.executable, "-c", ORPHANED], stdout=subprocess.PIPE, cwd=Path(__file__).parents[1]
    )
    with supervisor:
        assert supervisor.stdout is not None
        worker = psutil.Process(int(supervisor.stdout.readline()))
        assert worker.is_running()
        supervisor.kill()
    worker.wait(timeout=10)
    assert not worker.is_running()


def test_stop_ends_every_process() -> None:
    """After `stop` there is no worker, whether it was starting, idle, stopped by a signal, or at work."""

    async def stopped() -> None:
        for act in (lambda _: None, lambda engine: os.kill(engine.worker_pid, signal.SIGSTOP)):
            async with running() as engine:
                await until(engine, Readiness.READY)
                act(engine)
            assert not psutil.Process().children()
        async with running():
            pass
        assert not psutil.Process().children()

    patiently(stopped())


def test_a_stop_waits_no_longer_than_its_grace() -> None:
    """A kernel that never ends is ended after the grace time, and its caller told."""

    async def stopped() -> None:
        async with running(faulty("endless", grace_s=0.2)) as engine:
            hung = await begun(engine, film_work(1001.0))
            began_s = time.monotonic()
        assert time.monotonic() - began_s < scale(15, 3)
        with pytest.raises(UnavailableError):
            await hung
        assert not psutil.Process().children()

    patiently(stopped())
