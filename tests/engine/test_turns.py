"""Turns: one at a time, in the order asked, and nobody waits longer than agreed."""

import asyncio

import pytest

from nacreous.engine.turns import Turns
from nacreous.errors import BusyError, UnavailableError


class InHand:
    """A work that ends when it is told to."""

    def __init__(self) -> None:
        self.may_end = asyncio.Event()

    async def __call__(self) -> str:
        """Work."""
        await self.may_end.wait()
        return "done"


async def at_once() -> str:
    """Return without a wait."""
    return "at once"


def test_a_turn_that_does_not_come_in_time_is_given_up() -> None:
    """Who has waited as agreed is told to come again, and its place is free; a free turn needs no time."""

    async def test() -> None:
        turns, work = Turns(1), InHand()
        first = asyncio.create_task(turns.take(work, 60.0))
        await asyncio.sleep(0)
        with pytest.raises(BusyError, match="takes very long") as busy:
            await turns.take(at_once, 0.0)
        assert busy.value.retry_after_s >= 1
        assert (turns.busy, turns.queued) == (1, 0)
        work.may_end.set()
        assert await first == "done"
        assert await turns.take(at_once, 0.0) == "at once"

    asyncio.run(test())


def test_those_who_wait_are_refused_together() -> None:
    """Everyone in the queue hears the error, and the one in hand goes on."""

    async def test() -> None:
        turns, work = Turns(2), InHand()
        first, *waiting = (asyncio.create_task(turns.take(work, 60.0)) for _ in range(3))
        await asyncio.sleep(0)
        assert turns.queued == 2
        turns.refuse_waiting(lambda: UnavailableError("it stops", 1.0))
        answers = await asyncio.gather(*waiting, return_exceptions=True)
        assert [str(answer) for answer in answers] == ["it stops"] * 2
        assert not first.done()
        work.may_end.set()
        assert await first == "done"
        await turns.idle()
        assert (turns.busy, turns.queued) == (0, 0)

    asyncio.run(test())
