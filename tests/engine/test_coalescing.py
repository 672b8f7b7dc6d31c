"""One computation for all who ask for the same, whoever of them goes away."""

import asyncio
from collections.abc import Callable, Coroutine
from typing import Any

import pytest

from nacreous.engine.coalescing import Coalescing

Observer = Callable[[float], None]


class Computation:
    """Begins when it is told to, ends when it is told to, and counts how often it was started."""

    def __init__(self) -> None:
        self.started = self.finished = 0
        self.has_begun, self.may_begin, self.may_end = asyncio.Event(), asyncio.Event(), asyncio.Event()

    async def __call__(self, observer: Observer) -> str:
        """Compute."""
        self.started += 1
        await self.may_begin.wait()
        observer(0.5)
        self.has_begun.set()
        await self.may_end.wait()
        self.finished += 1
        return "a table"


def in_loop(test: Callable[[], Coroutine[Any, Any, None]]) -> Callable[[], None]:
    """Run a test in an event loop of its own."""

    def run() -> None:
        asyncio.run(test())

    run.__doc__, run.__name__ = test.__doc__, test.__name__
    return run


async def _started(computation: Computation, callers: int) -> tuple[Coalescing[str], list[asyncio.Task[str]]]:
    coalescing = Coalescing[str]()
    tasks = [asyncio.create_task(coalescing.share("film", computation)) for _ in range(callers)]
    await asyncio.sleep(0)  # every caller has asked
    return coalescing, tasks


@in_loop
async def test_callers_at_the_same_time_share_one_computation() -> None:
    """N waiting callers, one computation, N answers."""
    computation = Computation()
    coalescing, tasks = await _started(computation, 10)
    computation.may_begin.set()
    computation.may_end.set()
    assert await asyncio.gather(*tasks) == ["a table"] * 10
    assert (computation.started, coalescing.joined) == (1, 9)


@in_loop
async def test_the_first_caller_may_go_away() -> None:
    """The computation belongs to nobody: who started it can leave it to the others."""
    computation = Computation()
    _, (first, other) = await _started(computation, 2)
    computation.may_begin.set()
    first.cancel()
    computation.may_end.set()
    assert await other == "a table"
    assert first.cancelled()
    assert computation.started == 1


@in_loop
async def test_what_has_begun_is_finished_for_whoever_asks_next() -> None:
    """When all have gone away, what is half done is not thrown away."""
    computation = Computation()
    coalescing, tasks = await _started(computation, 2)
    computation.may_begin.set()
    await computation.has_begun.wait()
    for task in tasks:
        task.cancel()
    computation.may_end.set()
    await coalescing.settle()
    assert computation.finished == 1


@in_loop
async def test_what_has_not_begun_ends_with_its_last_caller() -> None:
    """What only waits for its turn gives it up; whoever asks then starts anew."""
    computation = Computation()
    coalescing, (one, other) = await _started(computation, 2)
    one.cancel()
    other.cancel()
    await asyncio.sleep(0)
    late = asyncio.create_task(coalescing.share("film", computation))
    computation.may_begin.set()
    computation.may_end.set()
    assert await late == "a table"
    assert (computation.started, computation.finished) == (2, 1)


@in_loop
async def test_an_error_reaches_every_caller_and_is_not_kept() -> None:
    """All who wait hear of it; who asks later tries again."""

    async def fails(_: Observer) -> str:
        raise ValueError("no table")

    coalescing = Coalescing[str]()
    results = await asyncio.gather(
        *(coalescing.share("film", fails) for _ in range(3)), return_exceptions=True
    )
    assert [str(result) for result in results] == ["no table"] * 3
    with pytest.raises(ValueError, match="no table"):
        await coalescing.share("film", fails)


@in_loop
async def test_observers_are_told_while_they_wait() -> None:
    """Each caller who wants to know hears how far it is; one who has left hears no more."""
    told: list[float] = []
    computation, coalescing = Computation(), Coalescing[str]()
    watching = asyncio.create_task(coalescing.share("film", computation, told.append))
    gone = asyncio.create_task(coalescing.share("film", computation, lambda _: pytest.fail("it has left")))
    await asyncio.sleep(0)
    gone.cancel()
    await asyncio.wait([gone])
    computation.may_begin.set()
    computation.may_end.set()
    await watching
    assert told == [0.5]
