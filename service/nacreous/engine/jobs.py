"""Jobs: sweeps that are computed one table after the other, and survive the process.

A job is a manifest in the store, and its progress is which files exist: a restarted process goes on where the
last one was. Of all jobs together one table at a time is in the engine's queue, so that requests which
somebody waits for are never behind more than that; jobs take turns by tables.
"""

import asyncio
import logging
import time
from collections import OrderedDict, deque
from collections.abc import AsyncIterator
from dataclasses import dataclass, replace
from typing import Any

from nacreous.engine.active_job import ActiveJob
from nacreous.engine.job import JOBS, Failure, Job, JobState, Manifest, manifest_key
from nacreous.engine.library import Library
from nacreous.engine.sweep import MAX_TABLES, Sweep
from nacreous.engine.work import Work
from nacreous.errors import (
    BusyError,
    DeviceError,
    MissingError,
    NacreousError,
    SpecError,
    StoreError,
    UnavailableError,
)
from nacreous.opencl.tiles import Observer
from nacreous.store.store import Store

__all__ = ["Failure", "Job", "JobLimits", "JobState", "Jobs"]

_log = logging.getLogger(__name__)

_ENDED_IN_MEMORY = 16
"""Jobs of 10,000 tables have names of 2 MB; those that ended before are read from their manifests."""
_TRIES = 3
"""How often a table is tried that a ready engine cannot compute just then."""
_WAIT_S = (0.05, 5.0)
"""Bounds of what is waited before the next try."""
_LOOK_S = 1.0
"""Between two looks at the manifest of a job that another process computes."""
_RETRY_AFTER_S = 30.0


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
    deadline_s : float
        For one table; nobody waits for it as for a request.
    """

    tables: int = MAX_TABLES
    waiting: int = 256
    kept: int = 1_000
    deadline_s: float = 1_800.0


class Jobs:
    """The jobs of one store; used from one event loop.

    Parameters
    ----------
    library : Library
    store : Store
    limits : JobLimits
    """

    def __init__(self, library: Library, store: Store, limits: JobLimits | None = None) -> None:
        self._library, self._store = library, store
        self._limits = limits or JobLimits()
        self._active: dict[str, ActiveJob] = {}
        self._turns: deque[ActiveJob] = deque()
        self._ended: OrderedDict[str, Job] = OrderedDict()
        self._manifests: deque[str] = deque()
        self._come = asyncio.Event()
        self._runner: asyncio.Task[None] | None = None
        self._stopped = False

    async def start(self) -> None:
        """Begin to work, first on what an earlier process left unfinished; return at once."""
        self._stopped = False
        self._runner = asyncio.create_task(self._run())

    async def stop(self) -> None:
        """Begin nothing more, and end all `events`; manifests stay as they are, for the next process.

        What the engine computes just then it finishes, and `Library.settle` waits until it is stored.
        """
        self._stopped = True
        if self._runner is not None:
            self._runner.cancel()
            await asyncio.wait([self._runner])
        for active in self._active.values():
            active.wake()

    async def add(self, sweep: Sweep) -> Job:
        """Put a sweep in the queue, and return its job.

        One that is under way or has been done is left alone; one that failed, in part at least, or has been
        cancelled, is tried again.

        Raises
        ------
        SpecError
            It has more tables than a job may have.
        BusyError
            Too many jobs wait.
        StoreError
            Its manifest cannot be written.
        """
        if len(sweep) > self._limits.tables:
            raise SpecError("vary", f"at most {self._limits.tables:,} tables", f"{len(sweep):,}")
        fresh = await asyncio.to_thread(Job.of, sweep)
        known = None if fresh.id in self._active else await self._known(fresh.id)
        if known is not None and known.state is JobState.DONE and not known.failed:
            return known
        if len(self._active) >= self._limits.waiting and fresh.id not in self._active:
            raise BusyError(f"{len(self._active):,} jobs wait already", _RETRY_AFTER_S)
        active = ActiveJob(sweep, fresh, sweep.to_document())
        if fresh.id not in self._active:
            await self._write(active.document, fresh)
        return self._activated(active).job

    async def get(self, job_id: str) -> Job:
        """Return a job as it is now; raises `MissingError`, or `StoreError` where nobody can tell."""
        job = await self._known(job_id)
        if job is None:
            raise MissingError(f"there is no job {job_id}")
        return job

    async def cancel(self, job_id: str) -> Job:
        """End a job, whose finished tables stay, and return it; one that has ended is left alone.

        Raises
        ------
        MissingError
            There is no such job.
        StoreError
            It has ended, and cannot be prevented from going on in the next process.
        """
        active = self._active.get(job_id)
        if active is not None:
            self._end(active, state=JobState.CANCELLED)
            await self._write(active.document, active.job)
            return active.job
        job = await self.get(job_id)
        if job.ended:
            return job
        manifest = await asyncio.to_thread(self._manifest, job_id)
        cancelled = replace(job, state=JobState.CANCELLED)
        await self._write(manifest.document if manifest else {}, cancelled)
        return cancelled

    async def events(self, job_id: str) -> AsyncIterator[Job]:
        """Yield a job as it is now and at every change, to the last; end early where the jobs stop.

        Who reads slowly misses what was in between, never the last. `MissingError` comes at the first step.
        """
        told: Job | None = None
        active: ActiveJob | None = None
        while told is None or not (told.ended or self._stopped):
            active = self._active.get(job_id, active)
            job = active.job if active else await self.get(job_id)
            if job != told:
                told = job
                yield job
            elif active is not None:
                await active.changed.wait()
            else:  # another process has it, or this one has yet to find it in the store
                await asyncio.sleep(_LOOK_S)

    # ---- one table after the other ---------------------------------------------------------------------

    async def _run(self) -> None:
        await self._resume()
        while True:
            while self._turns:
                await self._advance(self._turns.popleft())
            self._come.clear()
            await self._come.wait()

    async def _resume(self) -> None:
        """Find what has not ended; a store that cannot be read is tried until it can."""
        while True:
            try:
                unfinished = await asyncio.to_thread(self._unfinished)
            except StoreError as error:
                _log.warning("jobs cannot be resumed yet: %s", error)
                await asyncio.sleep(_WAIT_S[1])
            else:
                break
        for active in unfinished:
            self._activated(active)

    def _unfinished(self) -> list[ActiveJob]:
        """Read every manifest, the oldest job first."""
        found = [self._manifest(key.removeprefix(JOBS)) for key in self._store.keys(JOBS)]
        manifests = sorted((m for m in found if m is not None), key=lambda m: m.job.created)
        self._manifests.extend(m.job.id for m in manifests if m.job.ended)
        return [active for m in manifests if not m.job.ended and (active := self._revived(m)) is not None]

    def _revived(self, manifest: Manifest) -> ActiveJob | None:
        """Return a job of an earlier process; one of an earlier version has other tables, and ends."""
        try:
            sweep = Sweep.from_document(manifest.document, manifest.job.total)
            if sweep.id == manifest.job.id:
                return ActiveJob(sweep, replace(manifest.job, state=JobState.QUEUED), manifest.document)
            fault = "it is of another version of Nacreous; send it again"
        except SpecError as error:
            fault = str(error)
        _log.warning("job %s cannot go on: %s", manifest.job.id, fault)
        failed = replace(manifest.job, state=JobState.FAILED, error=fault)
        self._store.put(manifest_key(failed.id), Manifest(failed, manifest.document).to_entry())
        return None

    def _activated(self, active: ActiveJob) -> ActiveJob:
        """Give a job its turns, unless it has them already."""
        known = self._active.setdefault(active.job.id, active)
        if known is active:
            self._ended.pop(active.job.id, None)
            self._turns.append(active)
            self._come.set()
        return known

    async def _advance(self, active: ActiveJob) -> None:
        """Make the next table of a job, and give the job its next turn, or its end."""
        if active.job.ended:
            return
        try:
            if await self._cancelled_elsewhere(active):
                self._end(active, state=JobState.CANCELLED)
            elif active.next < len(active.sweep):
                await self._table_in_hand(active)
                self._turns.append(active)
            else:
                await self._finish(active)
        except StoreError as error:
            _log.warning("job %s stops: %s", active.job.id, error)
            self._end(active, state=JobState.FAILED, error=str(error))
        except Exception:  # noqa: BLE001 - a fault of ours must not stop the other jobs for ever
            _log.exception("job %s stops", active.job.id)
            self._end(active, state=JobState.FAILED, error="a fault of Nacreous; its log has more")

    async def _table_in_hand(self, active: ActiveJob) -> None:
        """Make one table in a task of its own, which `cancel` may end."""
        active.in_hand = task = asyncio.create_task(self._table(active))
        try:
            await asyncio.wait([task])
        finally:
            active.in_hand = None
            task.cancel()  # the jobs stop
        if not task.cancelled():
            task.result()

    async def _table(self, active: ActiveJob) -> None:
        index, active.next = active.next, active.next + 1
        active.become(state=JobState.RUNNING)
        try:
            works = await asyncio.to_thread(active.works, index)
            files = len(works) * active.job.total
            for place, work in enumerate(works, index * len(works)):
                await self._kept(work, active.observer(place, files))
        except StoreError:
            raise
        except NacreousError as error:
            active.failed(Failure(index, str(error)))
        else:
            active.made(works)

    async def _kept(self, work: Work, observer: Observer) -> None:
        """Have a work computed and stored, when the engine has time for it."""
        tries = 0
        while True:
            try:
                return await self._library.keep(work, observer, self._limits.deadline_s)
            except (BusyError, UnavailableError, DeviceError) as error:
                tries += self._library.ready and not isinstance(error, BusyError)
                if tries == _TRIES:
                    raise
                least, most = _WAIT_S
                await asyncio.sleep(min(most, max(least, getattr(error, "retry_after_s", 1.0))))

    async def _finish(self, active: ActiveJob) -> None:
        failed = active.job.failed == active.job.total
        error = active.job.failures[0].message if failed else ""
        state = JobState.FAILED if failed else JobState.DONE
        changes: dict[str, Any] = {"state": state, "fraction": 1.0, "error": error}
        await self._write(active.document, replace(active.job, **changes))
        await self._make_room()
        self._end(active, **changes)

    def _end(self, active: ActiveJob, **changes: Any) -> None:  # noqa: ANN401 - fields of a job
        """Give a job its last state, once."""
        if active.job.ended:
            return
        active.become(**changes)
        self._active.pop(active.job.id)
        self._ended[active.job.id] = active.job
        self._manifests.append(active.job.id)
        while len(self._ended) > _ENDED_IN_MEMORY:
            self._ended.popitem(last=False)
        if active.in_hand is not None:
            active.in_hand.cancel()

    async def _make_room(self) -> None:
        """Delete the manifests of the jobs that ended the longest ago, so that one more may end."""
        while len(self._manifests) >= self._limits.kept:
            job_id = self._manifests.popleft()
            if job_id not in self._active and job_id not in self._manifests:
                self._ended.pop(job_id, None)
                await asyncio.to_thread(self._store.delete, manifest_key(job_id))

    # ---- manifests ---------------------------------------------------------------------------------------

    async def _known(self, job_id: str) -> Job | None:
        manifest_key(job_id)
        active = self._active.get(job_id)
        job = active.job if active else self._ended.get(job_id)
        if job is not None:
            return job
        manifest = await asyncio.to_thread(self._manifest, job_id)
        return manifest.job if manifest else None

    async def _cancelled_elsewhere(self, active: ActiveJob) -> bool:
        """Tell whether another process has been asked to end a job; looked at once in a while."""
        if time.monotonic() < active.look_at:
            return False
        active.look_at = time.monotonic() + _LOOK_S
        manifest = await asyncio.to_thread(self._manifest, active.job.id)
        return manifest is not None and manifest.job.state is JobState.CANCELLED

    def _manifest(self, job_id: str) -> Manifest | None:
        """Read a manifest, in a thread; one that cannot be understood is as if it were not there."""
        try:
            entry = self._store.get(manifest_key(job_id))
            return None if entry is None else Manifest.from_entry(entry)
        except (ValueError, MissingError) as error:
            _log.warning("the manifest of job %s is left alone: %s", job_id, error)
            return None

    async def _write(self, document: dict[str, Any], job: Job) -> None:
        entry = Manifest(job, document).to_entry()
        await asyncio.to_thread(self._store.put, manifest_key(job.id), entry)
