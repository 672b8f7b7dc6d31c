"""What one running service is made of."""

import asyncio
from contextlib import suppress
from dataclasses import dataclass, field

from starlette.requests import Request

from nacreous.engine.engine import Engine, Readiness
from nacreous.engine.jobs import JobLimits, Jobs
from nacreous.engine.library import Library
from nacreous.errors import StoreError
from nacreous.store.store import Store, open_store
from nacreous.web.caching import IMMUTABLE
from nacreous.web.metrics import Metrics, ServiceCollector
from nacreous.web.settings import Settings

__all__ = ["Service", "make_service", "service_of"]


@dataclass(eq=False)
class Service:
    """The parts of a service.

    Parameters
    ----------
    settings : Settings
    store : Store
    engine : Engine
    library : Library
    jobs : Jobs
    metrics : Metrics
    """

    settings: Settings
    store: Store
    engine: Engine
    library: Library
    jobs: Jobs
    metrics: Metrics
    _stopping: asyncio.Event = field(default_factory=asyncio.Event)
    _was_writable: bool = False
    _running: int = 0
    _idle: asyncio.Event = field(default_factory=asyncio.Event)

    @property
    def cache_control(self) -> bytes:
        """Cache-Control of files that never change: no shared cache may hand on what needs a key."""
        return (b"private, " if self.settings.api_keys else b"public, ") + IMMUTABLE

    @property
    def stopping(self) -> asyncio.Event:
        """Set once the service is on its way out: it finishes what it does and takes nothing new."""
        return self._stopping

    async def store_fault(self) -> str:
        """Return why the store cannot be written; nothing where it can."""
        try:
            await asyncio.to_thread(self.store.check_writable)
        except StoreError as error:
            return str(error)
        self._was_writable = True
        return ""

    def reason_not_ready(self, store_fault: str) -> str:
        """Return why requests should go elsewhere; nothing where all is well.

        A store that never could be written is a wrong setting. One that no longer can, because its disk is
        full, still gives what it has, and tables are answered without it.
        """
        if self._stopping.is_set():
            return "the service is stopping"
        state = self.engine.state
        if state.readiness is not Readiness.READY:
            return f"the engine is {state.readiness}" + (f": {state.reason}" if state.reason else "")
        return f"the store cannot be used: {store_fault}" if store_fault and not self._was_writable else ""

    @property
    def running(self) -> int:
        """Requests that are being answered, probes aside."""
        return self._running

    def request_begins(self) -> None:
        """Count a request until `request_ends`."""
        self._running += 1

    def request_ends(self) -> None:
        """Count one less, and tell who waits for the last."""
        self._running -= 1
        if not self._running:
            self._idle.set()

    async def requests_done(self, within_seconds: float) -> None:
        """Wait until no request is being answered, or the time is over."""
        with suppress(TimeoutError):
            async with asyncio.timeout(within_seconds):
                while self._running:
                    self._idle.clear()
                    await self._idle.wait()

    async def start(self) -> None:
        """Begin to work."""
        await self.engine.start()
        await self.jobs.start()

    async def drain(self) -> None:
        """Begin nothing more: requests whose table has not been begun are told to come again."""
        self._stopping.set()
        await self.jobs.stop()
        self.engine.drain()

    async def stop(self) -> None:
        """Finish what is being computed, within the engine's grace time, and free everything."""
        self._stopping.set()
        await self.jobs.stop()
        await self.engine.stop()
        await self.library.settle()


def make_service(settings: Settings, engine: Engine) -> Service:
    """Return the service of these settings around an engine."""
    store = open_store(settings.store, settings.quota_bytes)
    library = Library(store, engine, settings.hot_bytes)
    jobs = Jobs(
        library, store, JobLimits(tables=settings.job_tables, deadline_s=settings.job_deadline_seconds)
    )
    service = Service(settings, store, engine, library, jobs, Metrics())
    service.metrics.registry.register(ServiceCollector(service))
    return service


def service_of(request: Request) -> Service:
    """Return the service that a request has come to."""
    service: Service = request.app.state.service
    return service
