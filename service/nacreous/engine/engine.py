"""The interface of all engines."""

from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

from nacreous.engine.work import Product, Work
from nacreous.opencl.tiles import Observer

__all__ = ["Engine", "EngineState", "Readiness"]


class Readiness(StrEnum):
    """Whether an engine takes work."""

    STARTING = "starting"
    READY = "ready"
    FAILED = "failed"
    STOPPED = "stopped"


@dataclass(frozen=True)
class EngineState:
    """How an engine is: its readiness, and where it is not ready the reason, in one line."""

    readiness: Readiness
    reason: str = ""


class Engine(Protocol):
    """Computes tables, one at a time a device; used from one event loop."""

    @property
    def state(self) -> EngineState:
        """Whether work is taken now, and why not."""
        ...

    @property
    def queued(self) -> int:
        """Works that wait."""
        ...

    @property
    def busy(self) -> int:
        """Works in hand."""
        ...

    @property
    def computed(self) -> int:
        """Works done."""
        ...

    @property
    def restarts(self) -> int:
        """Workers that have been replaced."""
        ...

    async def start(self) -> None:
        """Begin to make the engine ready, and return at once; `state` says what became of it."""
        ...

    def drain(self) -> None:
        """Take no more work and refuse what waits; what is in hand goes on until `stop`."""
        ...

    async def stop(self) -> None:
        """Let what is being computed finish within the grace time, and free everything; refuse what waits."""
        ...

    async def compute(
        self, work: Work, observer: Observer | None = None, deadline_s: float | None = None
    ) -> Product:
        """Return what comes of the work, within `deadline_s` or, without one, the engine's own deadline.

        Cancelling one caller ends its waiting alone where the work has begun.

        Raises
        ------
        SpecError, BudgetError, DeviceError, NumericalError, FileFormatError
            As `nacreous.engine.work.compute` raises them.
        BusyError
            The queue is full.
        UnavailableError
            The worker has been lost twice over this work, or the engine has failed or stops.
        DeadlineError
            It took longer than it may.
        """
        ...
