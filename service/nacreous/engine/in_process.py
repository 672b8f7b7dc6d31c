"""The engine of programs that compute for themselves: one thread of this process, and no supervision.

A driver that crashes takes the process along, and a kernel that never ends is waited for: a service that must
stay up uses `nacreous.engine.worker_engine`.
"""

import asyncio
import threading
import time
from concurrent.futures import ThreadPoolExecutor

from nacreous.engine.engine import EngineState, Readiness
from nacreous.engine.queued import QueuedEngine
from nacreous.engine.work import Product, Work, compute
from nacreous.errors import DeadlineError, DeviceError, UnavailableError
from nacreous.opencl.device import open_device
from nacreous.opencl.tiles import Observer

__all__ = ["InProcessEngine"]

_RETRY_S = 1.0
_STARTING = EngineState(Readiness.STARTING, "the device is being opened")
_STOPPED = EngineState(Readiness.STOPPED, "the engine does not run")


class InProcessEngine(QueuedEngine):
    """Computes in a thread of its own, which is never replaced; see `nacreous.engine.engine.Engine`.

    Parameters
    ----------
    deadline_s : float
        How long a work may take; looked at between tiles.
    queue_length : int
        Works that may wait beside the one in hand.
    grace_s : float
        How long `stop` lets the work in hand go on.

    Attributes
    ----------
    state : EngineState
    """

    def __init__(self, deadline_s: float = 60.0, queue_length: int = 64, grace_s: float = 15.0) -> None:
        super().__init__(queue_length)
        self._deadline_s, self._grace_s = deadline_s, grace_s
        self._thread: ThreadPoolExecutor | None = None
        self._given_up = threading.Event()
        self.state = _STOPPED

    async def start(self) -> None:
        """Begin to open the device, and return at once; works asked for meanwhile wait for it."""
        self.state = _STARTING
        self._given_up.clear()
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="nacreous-engine")
        opened = asyncio.wrap_future(self._thread.submit(_device_fault))
        opened.add_done_callback(self._opened)

    def drain(self) -> None:
        """Take no more work and refuse what waits; what is in hand goes on until `stop`."""
        self.state = _STOPPED
        self._turns.refuse_waiting(self._unavailable)

    async def stop(self) -> None:
        """Let the work in hand finish within the grace time; what waits is refused at once."""
        self.drain()
        if self._thread is None:
            return
        thread, self._thread = self._thread, None
        timer = asyncio.get_running_loop().call_later(self._grace_s, self._given_up.set)
        await self._turns.idle()
        timer.cancel()
        thread.shutdown()

    async def compute(
        self, work: Work, observer: Observer | None = None, deadline_s: float | None = None
    ) -> Product:
        """Return what comes of the work; the observer is called from the event loop. See `Engine.compute`."""
        if self.state is _STOPPED:
            raise self._unavailable()
        tell = _in_loop(observer)
        within_s = deadline_s or self._deadline_s
        return await self._turns.take(lambda: self._compute(work, tell, within_s), within_s)

    async def _compute(self, work: Work, tell: Observer, within_s: float) -> Product:
        if self._thread is None:
            raise self._unavailable()
        limit = time.monotonic() + within_s

        def observe(fraction: float) -> None:
            if self._given_up.is_set():
                raise self._unavailable()
            if time.monotonic() > limit:
                raise DeadlineError(f"the table takes longer than {within_s:g} s")
            tell(fraction)

        product = await asyncio.wrap_future(self._thread.submit(compute, work, observe))
        self.computed += 1
        return product

    def _opened(self, opened: "asyncio.Future[str]") -> None:
        if self.state is _STARTING:
            fault = opened.result()
            self.state = EngineState(Readiness.FAILED, fault) if fault else EngineState(Readiness.READY)

    def _unavailable(self) -> UnavailableError:
        return UnavailableError(self.state.reason, _RETRY_S)


def _device_fault() -> str:
    """Return why the device cannot be opened; nothing where it can."""
    try:
        open_device()
    except DeviceError as error:
        return str(error)
    return ""


def _in_loop(observer: Observer | None) -> Observer:
    """Return what calls an observer in this event loop, from any thread."""
    loop = asyncio.get_running_loop()

    def tell(fraction: float) -> None:
        if observer is not None:
            loop.call_soon_threadsafe(observer, fraction)

    return tell
