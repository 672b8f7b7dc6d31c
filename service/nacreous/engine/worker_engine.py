"""The engine of the service: one worker process, watched, and replaced whatever becomes of it.

This process never touches OpenCL. PoCL turns a damaged kernel cache, a full disk or too little memory into
the end of its process, and a kernel that never ends can only be ended with it.
"""

import asyncio
import logging
from contextlib import suppress

from nacreous.engine.engine import EngineState, Readiness
from nacreous.engine.poison import Poison
from nacreous.engine.queued import QueuedEngine
from nacreous.engine.work import Product, Work
from nacreous.engine.worker_process import WorkerFaultError, WorkerLostError, WorkerProcess
from nacreous.engine.worker_settings import WorkerSettings
from nacreous.engine.worker_start import WorkerStarter
from nacreous.errors import DeadlineError, DeviceError, UnavailableError
from nacreous.opencl.tiles import Observer

__all__ = ["WorkerEngine", "WorkerSettings"]

_RETRY_S = 2.0
_CLOSE_S = 1.0
"""How long an idle worker may take to end by itself."""
_FREE_LOSSES = 3
"""Workers in a row that may end without a product before the next is waited for, longer every time."""
_PAUSES_S = (0.1, 2.0)

_BUILD_PROGRAM_FAILURE = -11
"""Of cl.h: all kernels have been compiled when they were tested, so that the cached form is damaged."""

_STOPPED = EngineState(Readiness.STOPPED, "the engine does not run")
_FIRST_START = EngineState(Readiness.STARTING, "the worker starts")
_REPLACED = EngineState(Readiness.STARTING, "the worker is being replaced")

_log = logging.getLogger(__name__)


class WorkerEngine(QueuedEngine):
    """Computes in a worker process, one work after the other; see `nacreous.engine.engine.Engine`.

    Parameters
    ----------
    settings : WorkerSettings, optional

    Attributes
    ----------
    state : EngineState
    """

    def __init__(self, settings: WorkerSettings | None = None) -> None:
        self._settings = settings or WorkerSettings()
        super().__init__(self._settings.queue_length)
        self._poison = Poison(self._settings.refused_s)
        self._starter = WorkerStarter(self._settings)
        self._worker: WorkerProcess | None = None
        self._supervision: asyncio.Task[None] | None = None
        self._changed = asyncio.Event()
        self._losses = 0
        self.state = _STOPPED

    @property
    def kernel_wipes(self) -> int:
        """How often compiled kernels have been thrown away because a worker has crashed."""
        return self._starter.wipes

    @property
    def worker_pid(self) -> int | None:
        """Process id of the worker, where there is one that takes work."""
        return self._worker.pid if self._worker else None

    async def start(self) -> None:
        """Begin to start a worker, and return at once; works asked for meanwhile wait for it."""
        self._become(_FIRST_START)
        self._worker = None
        self._supervision = asyncio.create_task(self._supervise())

    def drain(self) -> None:
        """Take no more work and refuse what waits; what is in hand goes on until `stop`."""
        self._become(_STOPPED)
        self._turns.refuse_waiting(self._unavailable)

    async def stop(self) -> None:
        """Let the work in hand finish within the grace time, and end the worker; what waits is refused."""
        self.drain()
        with suppress(TimeoutError):
            async with asyncio.timeout(self._settings.grace_s):
                await self._turns.idle()
        if self._supervision:
            self._supervision.cancel()
            await asyncio.wait([self._supervision])
        await self._turns.idle()

    async def compute(
        self, work: Work, observer: Observer | None = None, deadline_s: float | None = None
    ) -> Product:
        """Return what comes of the work; the observer is called from the event loop. See `Engine.compute`."""
        self._check_taking()
        self._poison.check(work)
        within_s = deadline_s or self._settings.deadline_s
        return await self._turns.take(lambda: self._attempts(work, observer, within_s), within_s)

    # ---- computing -----------------------------------------------------------------------------------------

    async def _attempts(self, work: Work, observer: Observer | None, within_s: float) -> Product:
        """Have the work done, by a second worker where the first is lost over it."""
        try:
            return await self._attempt(work, observer, within_s)
        except (WorkerFaultError, WorkerLostError) as loss:
            _log.warning("table %s has cost its worker (%s) and is tried once more", work.id, loss)
        try:
            return await self._attempt(work, observer, within_s)
        except WorkerFaultError as fault:
            raise fault.error from None
        except WorkerLostError:
            raise UnavailableError("the worker has been lost twice over this table", _RETRY_S) from None

    async def _attempt(self, work: Work, observer: Observer | None, within_s: float) -> Product:
        worker = await self._ready_worker()
        self._poison.check(work)
        try:
            async with asyncio.timeout(within_s):
                product = await worker.compute(work, observer)
        except TimeoutError:
            self._poison.strike(work)
            self._discard(worker)
            raise DeadlineError(f"the table takes longer than {within_s:g} s") from None
        except (WorkerFaultError, WorkerLostError) as loss:
            self._poison.strike(work)
            self._discard(worker)
            if isinstance(loss, WorkerFaultError) and loss.code == _BUILD_PROGRAM_FAILURE:
                self._starter.suspect_kernels()
            raise
        self._poison.forgive(work)
        self.computed += 1
        self._losses = 0
        return product

    async def _ready_worker(self) -> WorkerProcess:
        """Return the worker, once it is ready; raises `UnavailableError` where it will not be soon."""
        while self._worker is None:
            self._check_taking()
            await self._changed.wait()
        return self._worker

    def _check_taking(self) -> None:
        if self.state.readiness in {Readiness.FAILED, Readiness.STOPPED}:
            raise self._unavailable()

    def _unavailable(self) -> UnavailableError:
        return UnavailableError(self.state.reason, max(_RETRY_S, self._starter.pause_s))

    # ---- keeping a worker ----------------------------------------------------------------------------------

    async def _supervise(self) -> None:
        try:
            while True:
                await self._keep_worker()
        except Exception as error:
            _log.exception("the supervision has failed")
            self._become(EngineState(Readiness.FAILED, f"the supervision has failed: {error}"))
            self._turns.refuse_waiting(self._unavailable)
            raise
        finally:
            self._starter.close()

    async def _keep_worker(self) -> None:
        """Start a worker, and return when it has ended and the next may be started."""
        try:
            worker = await self._starter.start()
        except DeviceError as error:
            await self._pause_after(error)
            return
        self._worker = worker
        self._become(EngineState(Readiness.READY))
        try:
            how = await worker.ended()
        finally:
            await worker.close(_CLOSE_S)
        self._discard(worker)
        _log.warning("%s", how)
        self.restarts += 1
        self._losses += 1
        if not worker.killed:
            self._starter.suspect_kernels()
        await asyncio.sleep(_pause_s(self._losses))

    async def _pause_after(self, error: DeviceError) -> None:
        """Say that no worker starts, where all has been tried, and wait until the next attempt."""
        _log.error("the worker does not start: %s", error)
        if self._starter.pause_s:
            self._become(EngineState(Readiness.FAILED, str(error)))
            self._turns.refuse_waiting(self._unavailable)
            await asyncio.sleep(self._starter.pause_s)

    def _discard(self, worker: WorkerProcess) -> None:
        """End a worker that is not to be used again; `_keep_worker` sees it end, and starts another."""
        worker.kill()
        if self._worker is worker:
            self._worker = None
            self._become(_REPLACED)

    def _become(self, state: EngineState) -> None:
        if self.state.readiness is Readiness.STOPPED and state is not _FIRST_START:
            return  # what happens on the way out is no news
        self.state = state
        self._changed.set()
        self._changed = asyncio.Event()


def _pause_s(losses: int) -> float:
    """Return how long to wait after so many workers in a row have ended without a product."""
    if losses <= _FREE_LOSSES:
        return 0.0
    first, most = _PAUSES_S
    return float(min(most, first * 2 ** (losses - _FREE_LOSSES)))
