"""Starting workers: each with folders of its own, and with what helps where one does not start.

A worker that cannot start with kernels from before is given an empty folder; one that cannot start with that
either, a folder elsewhere. After that, starts are further and further apart.
"""

import asyncio
import os
import shutil
import tempfile
import time
from pathlib import Path

from nacreous.engine.kernel_cache import KernelCache, take_cache, take_temporary_cache
from nacreous.engine.worker import MEMORY_CAP, PARENT
from nacreous.engine.worker_process import StartError, WorkerLostError, WorkerProcess
from nacreous.engine.worker_settings import WorkerSettings
from nacreous.errors import DeviceError, reason

__all__ = ["WorkerStarter"]

_WIPES_APART_S = 600.0
_FREE_STARTS = 3
"""With the kernels from before, with none, and elsewhere."""
_MOST_PAUSE_S = 30.0
_MIB = 2**20
_ALLOCATION = {"MALLOC_MMAP_THRESHOLD_": str(32 * _MIB), "MALLOC_TRIM_THRESHOLD_": str(256 * _MIB)}
"""For glibc: arrays of up to 32 MiB, its largest, lie in memory that the worker keeps. Given back and asked
for anew, their pages would be cleared for every step of every table: a fifth of the time of a small one."""


class WorkerStarter:
    """Starts one worker after the other.

    Parameters
    ----------
    settings : WorkerSettings

    Attributes
    ----------
    failures : int
        Starts that have failed since one did not.
    wipes : int
        How often the kernels have been thrown away.
    """

    def __init__(self, settings: WorkerSettings) -> None:
        self._settings = settings
        self._cache: KernelCache | None = None
        self._scratch: Path | None = None
        self._wiped_s = float("-inf")
        self.failures = self.wipes = 0

    @property
    def pause_s(self) -> float:
        """How long the next start should wait."""
        beyond = self.failures - _FREE_STARTS
        return 0.0 if beyond < 0 else float(min(_MOST_PAUSE_S, 2**beyond))

    async def start(self) -> WorkerProcess:
        """Return a worker that is ready; raises `DeviceError` with the reason where none is, in one line."""
        try:
            await self._prepared()
            worker = await self._ready_worker()
        except (DeviceError, OSError) as error:
            self.failures += 1
            raise DeviceError(_one_line(error)) from error
        self.failures = 0
        return worker

    def suspect_kernels(self) -> None:
        """Throw the kernels away, once in a while: a damaged one ends its worker when it is first used."""
        if self._cache and time.monotonic() - self._wiped_s >= _WIPES_APART_S:
            self._cache.wipe()
            self._wiped_s = time.monotonic()
            self.wipes += 1

    def close(self) -> None:
        """Give the folders back."""
        if self._cache:
            self._cache.release()
        if self._scratch:
            shutil.rmtree(self._scratch, ignore_errors=True)
        self._cache = self._scratch = None

    async def _prepared(self) -> None:
        """Prepare in a thread: a disk may be slow. It takes a lock, so that it is waited for in any case."""
        preparing = asyncio.create_task(asyncio.to_thread(self._prepare))
        try:
            await asyncio.shield(preparing)
        finally:
            await asyncio.wait([preparing])

    def _prepare(self) -> None:
        """Have folders for a worker: for its kernels, and for files that are gone with it."""
        self._prepare_cache()
        if self._scratch:
            shutil.rmtree(self._scratch, ignore_errors=True)
        self._scratch = Path(tempfile.mkdtemp(prefix="nacreous-worker-"))

    def _prepare_cache(self) -> None:
        if self._cache and (self.failures >= _FREE_STARTS - 1 or not self._cache.usable):
            self._cache.release()
            self._cache = None
        if self._cache is None:
            elsewhere = self.failures >= _FREE_STARTS - 1
            self._cache = take_temporary_cache() if elsewhere else take_cache(self._settings.cache_folder)

    async def _ready_worker(self) -> WorkerProcess:
        worker = await WorkerProcess.spawn(self._settings.command, self._environment())
        try:
            async with asyncio.timeout(self._settings.start_s):
                await worker.ready()
        except (StartError, TimeoutError, WorkerLostError) as error:
            raise DeviceError(await self._why(worker, error)) from error
        except BaseException:
            await worker.close(0)
            raise
        return worker

    async def _why(self, worker: WorkerProcess, error: Exception) -> str:
        """Return why a worker is not ready, once it has ended; do what may help the next one."""
        await worker.close(0)
        if isinstance(error, StartError) and error.cause == "device":
            self.failures = max(self.failures, _FREE_STARTS - 1)  # nothing else can be tried
        elif isinstance(error, StartError | TimeoutError) or not worker.killed:
            self.suspect_kernels()
        if isinstance(error, TimeoutError):
            return f"the worker is not ready within {self._settings.start_s:g} s"
        return str(error) if isinstance(error, StartError) else await worker.ended()

    def _environment(self) -> dict[str, str]:
        """Return the worker's environment: this process's own, and what the settings say."""
        assert self._cache is not None  # noqa: S101 - it has just been prepared
        own = {
            "POCL_CACHE_DIR": self._cache.folder,
            "PYOPENCL_NO_CACHE": 1,
            "TMPDIR": self._scratch,
            PARENT: os.getpid(),
            MEMORY_CAP: self._settings.memory_cap,
            "NACREOUS_BYTE_BUDGET": self._settings.byte_budget,
            "NACREOUS_DEVICE": self._settings.device,
        }
        settled = {name: str(value) for name, value in own.items() if value is not None}
        return {**_ALLOCATION, **os.environ, **settled}


def _one_line(error: Exception) -> str:
    """Return why a worker does not start: what is on the first line, the rest is in the log."""
    where = f"{error.filename}: " if isinstance(error, OSError) and error.filename else ""
    return where + reason(error).strip().partition("\n")[0]
