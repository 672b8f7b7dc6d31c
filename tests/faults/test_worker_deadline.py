"""A kernel that never ends: nobody waits for it longer than the deadline, and the event loop not at all."""

import asyncio
import os
import signal
import time

import numpy as np
import pytest

from faults.soak import scale
from nacreous.engine.engine import Readiness
from nacreous.engine.worker_engine import WorkerEngine, WorkerSettings
from nacreous.errors import DeadlineError, UnavailableError
from worker_engines import faulty, film_work, patiently, running, until

DEADLINE_S = 1.0
LATE_S = scale(50, 5) / 10
"""The promise is half a second; machines that run other tests meanwhile have more."""
LAG_S = scale(20, 1) / 10
"""99 in 100 turns of the event loop come within 100 ms; likewise."""


async def ticking(lags_s: list[float]) -> None:
    """Note how late each of an event loop's turns is."""
    while True:
        began_s = time.monotonic()
        await asyncio.sleep(0.005)
        lags_s.append(time.monotonic() - began_s - 0.005)


async def check_deadline(engine: WorkerEngine, thickness_nm: float) -> None:
    """Ask for what never comes: the deadline passes, meanwhile the event loop turns."""
    await until(engine, Readiness.READY)
    lags_s: list[float] = []
    clock = asyncio.create_task(ticking(lags_s))
    began_s = time.monotonic()
    with pytest.raises(DeadlineError, match=f"longer than {DEADLINE_S:g} s"):
        await engine.compute(film_work(thickness_nm))
    assert DEADLINE_S <= time.monotonic() - began_s <= DEADLINE_S + LATE_S
    clock.cancel()
    assert np.quantile(lags_s, 0.99) < LAG_S


def test_a_kernel_that_never_ends_is_ended() -> None:
    """An OpenCL kernel that loops for ever costs the deadline and a worker; the next work is done."""

    async def hung() -> None:
        async with running(faulty("endless", deadline_s=DEADLINE_S)) as engine:
            for number in range(scale(1, 10)):
                await check_deadline(engine, 1001.0 + number)
                assert (await engine.compute(film_work())).files
                assert engine.restarts == number + 1
            assert engine.kernel_wipes == 0

    patiently(hung())


def test_a_work_that_costs_two_deadlines_is_refused() -> None:
    """The third who asks for it hears so at once, for ten minutes; another work is done."""

    async def hung() -> None:
        async with running(faulty("endless", deadline_s=DEADLINE_S)) as engine:
            for _ in range(2):
                with pytest.raises(DeadlineError):
                    await engine.compute(film_work(1001.0))
            with pytest.raises(UnavailableError, match="ended its worker 2 times") as refused:
                await engine.compute(film_work(1001.0))
            assert refused.value.retry_after_s > 500
            assert (await engine.compute(film_work())).files
            assert engine.restarts == 2

    patiently(hung())


def test_a_worker_that_is_stopped_by_a_signal_is_replaced() -> None:
    """SIGSTOP: a worker that answers nothing at all is no other case."""

    async def stopped() -> None:
        async with running(WorkerSettings(deadline_s=DEADLINE_S)) as engine:
            await until(engine, Readiness.READY)
            pid = engine.worker_pid
            assert pid is not None
            os.kill(pid, signal.SIGSTOP)
            await check_deadline(engine, 420.0)
            await until(engine, Readiness.READY)
            assert engine.worker_pid != pid

    patiently(stopped())


def test_a_worker_that_never_starts_is_not_waited_for() -> None:
    """A program that says nothing is ended after its start time, and said to be so."""

    async def silent() -> None:
        async with running(WorkerSettings(command=("sleep", "1000"), start_s=0.1)) as engine:
            await until(engine, Readiness.FAILED)
            assert engine.state.reason == "the worker is not ready within 0.1 s"

    patiently(silent())
