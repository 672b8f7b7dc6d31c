"""A job that has not ended: what it makes next, and those who watch it."""

import asyncio
from dataclasses import dataclass, field, replace
from typing import Any

from nacreous.engine.job import FAILURES_TOLD, Failure, Job
from nacreous.engine.sweep import Sweep
from nacreous.engine.work import Work
from nacreous.opencl.tiles import Observer

__all__ = ["ActiveJob"]


@dataclass(eq=False)
class ActiveJob:
    """A job that has not ended; used from one event loop.

    Parameters
    ----------
    sweep : Sweep
    job : Job
        As it is now.
    document : mapping
        Of the sweep.
    next : int
        Index of the table that is made next.
    look_at : float
        When the manifest is to be looked at again, on the monotonic clock.
    in_hand : Task, optional
        What makes a table just then.
    changed : Event
        Set at the next change; another takes its place.
    """

    sweep: Sweep
    job: Job
    document: dict[str, Any]
    next: int = 0
    look_at: float = 0.0
    in_hand: "asyncio.Task[None] | None" = None
    changed: asyncio.Event = field(default_factory=asyncio.Event)

    def become(self, **changes: Any) -> None:  # noqa: ANN401 - fields of a job
        """Change the job and tell those who watch; one that has ended stays as it is."""
        if not self.job.ended:
            self.job = replace(self.job, **changes)
            self.wake()

    def wake(self) -> None:
        """Wake those who watch."""
        changed, self.changed = self.changed, asyncio.Event()
        changed.set()

    def works(self, index: int) -> tuple[Work, ...]:
        """Return the works of a table with their ids, for which materials are read: in a thread."""
        works = self.sweep[index]
        for work in works:
            work.id  # noqa: B018 - kept in the work
        return works

    def observer(self, place: int, files: int) -> Observer:
        """Return what notes the progress of the file at a place of all the job's files."""
        return lambda fraction: self.become(fraction=(place + fraction) / files)

    def made(self, works: tuple[Work, ...]) -> None:
        """Note one more finished table."""
        self.become(
            done=self.job.done + 1,
            tables=(*self.job.tables, works[0].id),
            specs=(*self.job.specs, self.next - 1),
            files=(*self.job.files, *(work.id + work.target.suffix for work in works)),
            fraction=self.next / self.job.total,
        )

    def failed(self, failure: Failure) -> None:
        """Note one more table that could not be made."""
        self.become(
            failed=self.job.failed + 1,
            failures=(*self.job.failures, failure)[:FAILURES_TOLD],
            fraction=self.next / self.job.total,
        )
