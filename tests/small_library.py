"""A library with all its real parts, and tables so small that a test can afford many."""

import asyncio
from collections.abc import AsyncIterator, Iterable
from contextlib import asynccontextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from nacreous.engine.in_process import InProcessEngine
from nacreous.engine.jobs import Job, JobLimits, Jobs
from nacreous.engine.library import Library
from nacreous.engine.sweep import Sweep
from nacreous.engine.work import Work
from nacreous.formats.names import FormatName
from nacreous.store.store import Store, open_store
from nacreous.tables.presets import preset
from nacreous.tables.spec import Spec

__all__ = ["Rooms", "ended", "opened", "small_spec", "small_sweep", "small_work", "thicknesses", "together"]

_SMALL = ("table.cos_theta=6", "table.thickness_scale=1", "table.wavelength_nm=[390, 500, 600, 730]")


@dataclass(frozen=True)
class Rooms:
    """A library and what it is made of."""

    library: Library
    engine: InProcessEngine
    store: Store
    jobs: Jobs


@asynccontextmanager
async def opened(
    place: Path | str,
    quota_bytes: int | None = None,
    limits: JobLimits | None = None,
    engine: InProcessEngine | None = None,
) -> AsyncIterator[Rooms]:
    """Open a library on a folder or a URL, with an engine of this process; close it as a server does."""
    store, engine = open_store(str(place), quota_bytes), engine or InProcessEngine()
    library = Library(store, engine)
    jobs = Jobs(library, store, limits)
    await engine.start()
    try:
        yield Rooms(library, engine, store, jobs)
    finally:
        await jobs.stop()
        await engine.stop()
        await library.settle()


def small_spec(name: str = "coated-lens", overrides: Iterable[str] = ()) -> Spec:
    """Return a preset with few samples."""
    return preset(name, (*_SMALL, *overrides))


def small_work(
    format: FormatName = FormatName.EXR,  # noqa: A002 - as Work has it
    stem: str = "",
    name: str = "coated-lens",
    overrides: Iterable[str] = (),
) -> Work:
    """Return a work of a few milliseconds."""
    return Work(small_spec(name, overrides), format, stem)


def thicknesses(count: int) -> dict[str, Any]:
    """Return an axis of so many thicknesses in nm."""
    return {"stack.layers.0.thickness_nm": [100 + 5 * place for place in range(count)]}


def small_sweep(count: int, formats: tuple[str, ...] = ("exr",)) -> Sweep:
    """Return a sweep of so many small tables."""
    base = small_spec().model_dump(mode="json")
    document = {"base": base, "formats": list(formats), "vary": thicknesses(count)}
    return Sweep.from_document(document)


async def ended(jobs: Jobs, job_id: str) -> Job:
    """Return a job when it has ended."""
    return [job async for job in jobs.events(job_id)][-1]


async def together(*tasks: "asyncio.Task[Any]") -> list[object]:
    """Await several at once, errors among the results."""
    return await asyncio.gather(*tasks, return_exceptions=True)
