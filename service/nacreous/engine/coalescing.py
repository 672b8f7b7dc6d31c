"""One computation for all who ask for the same while it is under way."""

import asyncio
from collections.abc import Callable, Coroutine
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

from nacreous.opencl.tiles import Observer

__all__ = ["Coalescing"]

Result = TypeVar("Result")


@dataclass(eq=False)
class _Flight(Generic[Result]):
    """A computation under way, which belongs to no caller.

    It has begun once it tells of progress; before that it only waits for its turn.
    """

    task: "asyncio.Task[Result]" = field(init=False)
    callers: int = 0
    begun: bool = False
    observers: list[Observer] = field(default_factory=list)

    def observe(self, fraction: float) -> None:
        """Pass on how far it is to those who want to know."""
        self.begun = True
        for observer in self.observers:
            observer(fraction)


class Coalescing(Generic[Result]):
    """Computations under way, by their keys; used from one event loop.

    A caller who goes away leaves the computation to the others. When all have gone, it ends where it had not
    begun, and otherwise finishes for whoever asks next.

    Attributes
    ----------
    joined : int
        Callers who found what they wanted under way.
    """

    def __init__(self) -> None:
        self._flights: dict[str, _Flight[Result]] = {}
        self.joined = 0

    async def share(
        self,
        key: str,
        start: Callable[[Observer], Coroutine[Any, Any, Result]],
        observer: Observer | None = None,
    ) -> Result:
        """Return what comes of `key`, started here where it is not under way.

        Parameters
        ----------
        key : str
        start : callable
            Returns the computation; it is to tell the observer it gets when it has begun.
        observer : callable, optional
            Told how far the computation is, while this caller waits for it.
        """
        flight = self._flights.get(key)
        if flight is None:
            flight = self._launched(key, start)
        else:
            self.joined += 1
        flight.callers += 1
        flight.observers += [observer] if observer else []
        try:
            return await asyncio.shield(flight.task)
        finally:
            flight.callers -= 1
            if observer:
                flight.observers.remove(observer)
            if not (flight.callers or flight.begun or flight.task.done()):
                self._abandon(key, flight)

    async def settle(self) -> None:
        """Wait until nothing is under way."""
        while self._flights:
            await asyncio.wait([flight.task for flight in self._flights.values()])

    def _launched(
        self, key: str, start: Callable[[Observer], Coroutine[Any, Any, Result]]
    ) -> _Flight[Result]:
        flight = _Flight[Result]()
        flight.task = asyncio.create_task(start(flight.observe))
        self._flights[key] = flight
        flight.task.add_done_callback(lambda task: self._landed(key, flight, task))
        return flight

    def _abandon(self, key: str, flight: _Flight[Result]) -> None:
        """End what nobody waits for; whoever asks from now on starts anew."""
        if self._flights.get(key) is flight:
            del self._flights[key]
        flight.task.cancel()

    def _landed(self, key: str, flight: _Flight[Result], task: "asyncio.Task[Result]") -> None:
        if self._flights.get(key) is flight:
            del self._flights[key]
        if not task.cancelled():
            task.exception()  # it has been looked at, should every caller be gone
