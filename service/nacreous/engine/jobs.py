"""Jobs: sweeps that are computed one table after the other, and survive the process.

A job is a manifest in the store, and its progress is which files exist. A restarted process goes on where
the last one was.
"""

from collections.abc import AsyncIterator
from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum

from nacreous.engine.library import Library
from nacreous.engine.sweep import MAX_TABLES, Sweep
from nacreous.store.store import Store

__all__ = ["Failure", "Job", "JobLimits", "JobState", "Jobs"]


class JobState(StrEnum):
    """How far a job is."""

    QUEUED = "queued"
    RUNNING = "running"
    DONE = "done"
    FAILED = "failed"
    CANCELLED = "cancelled"


@dataclass(frozen=True)
class Failure:
    """A table that could not be made: its index in the sweep, and why."""

    spec: int
    message: str


@dataclass(frozen=True)
class Job:
    """A job as it is at one moment.

    Parameters
    ----------
    id : str
        Id of the sweep.
    state : JobState
        Done also where some tables failed; failed where none could be made, or the store failed.
    total, done, failed : int
        Tables of the sweep, those finished, and those that could not be made.
    failures : tuple of Failure
        The first few of them.
    formats : tuple of str
        Names of the formats; none stands for the default format of each table.
    tables : tuple of str
        Ids of the tables that are finished, in the order of the sweep.
    files : tuple of str
        Names of their files, such as ``"ab12….exr"``.
    created : datetime
        In UTC.
    fraction : float
        How much is done, 0 to 1, the table that is being computed included.
    error : str
        Why the job as a whole failed.
    """

    id: str
    state: JobState
    total: int
    created: datetime
    done: int = 0
    failed: int = 0
    failures: tuple[Failure, ...] = ()
    formats: tuple[str, ...] = ()
    tables: tuple[str, ...] = ()
    files: tuple[str, ...] = ()
    fraction: float = 0.0
    error: str = ""

    @property
    def ended(self) -> bool:
        """Whether the state is the last."""
        return self.state in (JobState.DONE, JobState.FAILED, JobState.CANCELLED)


@dataclass(frozen=True)
class JobLimits:
    """What jobs may take up.

    Parameters
    ----------
    tables : int
        Of one job.
    waiting : int
        Jobs that have not ended; one more is a `BusyError`.
    kept : int
        Manifests of ended jobs in the store; the oldest go.
    """

    tables: int = MAX_TABLES
    waiting: int = 256
    kept: int = 1_000


class Jobs:
    """The jobs of one store; used from one event loop.

    Parameters
    ----------
    library : Library
    store : Store
    limits : JobLimits
    """

    def __init__(self, library: Library, store: Store, limits: JobLimits | None = None) -> None:
        raise NotImplementedError

    async def start(self) -> None:
        """Begin to work, first on what an earlier process left unfinished; return at once."""
        raise NotImplementedError

    async def stop(self) -> None:
        """Stop after the file that is being computed, and end all `events`; manifests stay as they are."""
        raise NotImplementedError

    async def add(self, sweep: Sweep) -> Job:
        """Put a sweep in the queue; one that is known, and has not failed or been cancelled, is left alone.

        Raises
        ------
        SpecError
            It has more tables than a job may have.
        BusyError
            Too many jobs wait.
        StoreError
            Its manifest cannot be written.
        """
        raise NotImplementedError

    async def get(self, job_id: str) -> Job:
        """Return a job as it is now; raises `MissingError`."""
        raise NotImplementedError

    async def cancel(self, job_id: str) -> Job:
        """End a job, whose finished tables stay; one that has ended is left alone. Raises `MissingError`."""
        raise NotImplementedError

    def events(self, job_id: str) -> AsyncIterator[Job]:
        """Yield a job as it is now and at every change, to the last.

        Who reads slowly misses what was in between, never the last. `MissingError` comes at the first step.
        """
        raise NotImplementedError
