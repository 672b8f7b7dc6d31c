"""Who is computed when: one work at a time in the order asked, and a bounded number that waits."""

import asyncio
import time
from collections import deque
from collections.abc import Callable, Coroutine
from typing import Any, TypeVar

from nacreous.errors import BusyError, NacreousError

__all__ = ["Turns"]

Result = TypeVar("Result")

_SMOOTHING = 0.2
"""Weight of the newest work in the running mean of what works take."""
_RETRY_S = (1.0, 60.0)
"""Bounds of what a refused caller is told to wait."""


class Turns:
    """A bounded queue with one place at its head; all of it in one event loop.

    Parameters
    ----------
    length : int
        How many may wait beside the one that has its turn.

    Attributes
    ----------
    busy : int
        How many have their turn: 0 or 1.
    """

    def __init__(self, length: int) -> None:
        self._length = length
        self._waiting: deque[asyncio.Future[None]] = deque()
        self._tasks: set[asyncio.Task[Any]] = set()
        self._mean_s = 0.0
        self.busy = 0

    @property
    def queued(self) -> int:
        """How many wait."""
        return len(self._waiting)

    async def take(self, work: Callable[[], Coroutine[Any, Any, Result]], within_s: float) -> Result:
        """Wait for a turn, `within_s` at most, and return what comes of `work`.

        Where the caller is cancelled before its turn, its place is given up; later, its work goes on.

        Raises
        ------
        BusyError
            Too many wait already, or the turn does not come.
        """
        try:
            async with asyncio.timeout(within_s):
                await self._turn()
        except TimeoutError:
            raise BusyError("what is computed just now takes very long", self._retry_after_s()) from None
        task = asyncio.create_task(self._timed(work))
        self._tasks.add(task)
        task.add_done_callback(self._end_turn)
        return await asyncio.shield(task)

    def refuse_waiting(self, error: Callable[[], NacreousError]) -> None:
        """Raise an error at everyone who waits."""
        while self._waiting:
            place = self._waiting.popleft()
            if not place.done():
                place.set_exception(error())

    async def idle(self) -> None:
        """Return when nobody has a turn."""
        while self._tasks:
            await asyncio.wait(self._tasks)

    async def _turn(self) -> None:
        if not self.busy:
            self.busy = 1
            return
        if self.queued >= self._length:
            raise BusyError(f"{self.queued} tables wait already", self._retry_after_s())
        place = asyncio.get_running_loop().create_future()
        self._waiting.append(place)
        try:
            await place
        except asyncio.CancelledError:
            if place.done() and not place.cancelled() and place.exception() is None:
                self._pass_on()  # the turn came in the moment of the cancellation
            elif place in self._waiting:
                self._waiting.remove(place)
            raise

    def _pass_on(self) -> None:
        """Give the turn to the first who still waits."""
        while self._waiting:
            place = self._waiting.popleft()
            if not place.done():
                place.set_result(None)
                return
        self.busy = 0

    def _end_turn(self, task: asyncio.Task[Any]) -> None:
        self._tasks.discard(task)
        if not task.cancelled():
            task.exception()  # it has been looked at, should the caller be gone
        self._pass_on()

    async def _timed(self, work: Callable[[], Coroutine[Any, Any, Result]]) -> Result:
        began = time.monotonic()
        try:
            return await work()
        finally:
            self._mean_s += _SMOOTHING * (time.monotonic() - began - self._mean_s)

    def _retry_after_s(self) -> float:
        """Return when half of those that wait will have had their turn, by what works took of late."""
        least, most = _RETRY_S
        return min(most, max(least, self._mean_s * self.queued / 2))
