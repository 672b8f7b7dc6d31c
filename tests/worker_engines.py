"""Engines with a real worker process, for the tests that end it, stop it, and give it what it cannot do."""

import asyncio
import os
import sys
from collections.abc import AsyncIterator, Callable, Coroutine
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from pathlib import Path
from typing import Any, TypeVar

from nacreous.engine.engine import Engine, Readiness
from nacreous.engine.work import Product, Work
from nacreous.engine.worker_engine import WorkerEngine, WorkerSettings
from nacreous.formats.names import FormatName
from nacreous.tables.spec import Spec

Result = TypeVar("Result")
Started = TypeVar("Started", bound=Engine)

WORKERS = Path(__file__).parent / "faults" / "workers"
"""Workers that have a fault: each serves as the real one does, and computes as its name says."""

PATIENCE_S = 3600.0 if os.environ.get("NACREOUS_SOAK") == "1" else 120.0
"""Beyond which a test is told that it hangs; no promise is measured with it."""


def film_work(thickness_nm: float = 420.0, size: int = 8, form: FormatName = FormatName.EXR) -> Work:
    """Return the work of a film on glass: of another id for another thickness, small by default."""
    film = {"material": {"n": 2.0}, "thickness_nm": thickness_nm}
    scales = {"start": 0.9, "stop": 1.1, "count": size}
    document = {
        "stack": {"incident": "air", "substrate": {"n": 1.5}, "layers": [film]},
        "table": {"cos_theta": size, "thickness_scale": scales},
    }
    return Work(Spec.from_document(document), form)


def long_work(thickness_nm: float = 420.0) -> Work:
    """Return a work of a second or more and very many tiles: its progress is told while it is in hand."""
    return film_work(thickness_nm, size=320)


def faulty(name: str, *arguments: str, **settings: Any) -> WorkerSettings:  # noqa: ANN401 - as the settings are
    """Return settings that start the worker of this name in place of the real one."""
    return WorkerSettings(command=(sys.executable, str(WORKERS / f"{name}.py"), *arguments), **settings)


@asynccontextmanager
async def started(engine: Started) -> AsyncIterator[Started]:
    """Start an engine, and stop it whatever happens."""
    await engine.start()
    try:
        yield engine
    finally:
        await engine.stop()


def running(settings: WorkerSettings | None = None) -> AbstractAsyncContextManager[WorkerEngine]:
    """Run an engine with a worker of these settings."""
    return started(WorkerEngine(settings))


async def until(engine: WorkerEngine, *readiness: Readiness) -> None:
    """Return when the engine is as ready as asked; it computes nothing meanwhile."""
    while engine.state.readiness not in readiness:
        await asyncio.sleep(0.01)


async def begun(engine: Engine, work: Work) -> "asyncio.Task[Product]":
    """Ask for a work, and return what asks once it is in hand."""
    told = asyncio.Event()
    asking = asyncio.create_task(engine.compute(work, lambda _: told.set()))
    await told.wait()
    return asking


async def at_first_progress(engine: WorkerEngine, work: Work, act: Callable[[], None]) -> Product:
    """Have a work done, and act once, when it is under way."""
    acted = False

    def observe(_: float) -> None:
        nonlocal acted
        if not acted:
            acted = True
            act()

    product = await engine.compute(work, observe)
    assert acted, "the work was done before it told of its progress: it is too short for this test"
    return product


def patiently(test: Coroutine[Any, Any, Result]) -> Result:
    """Run a test of an engine in an event loop, and end it where it hangs."""
    return asyncio.run(asyncio.wait_for(test, PATIENCE_S))
