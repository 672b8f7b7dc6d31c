"""Works that have cost workers: refused after two, for ten minutes, and forgiven when done."""

import pytest

from nacreous.engine.poison import Poison
from nacreous.errors import UnavailableError
from nacreous.formats.names import FormatName
from worker_engines import film_work

WORK = film_work()


class Clock:
    """A clock that is moved by hand."""

    now_s = 0.0

    def __call__(self) -> float:
        """Return the time."""
        return self.now_s


def test_two_strikes_are_a_refusal_for_ten_minutes() -> None:
    """One strike is none; after the second, the refusal says how long it lasts."""
    clock = Clock()
    poison = Poison(clock=clock)
    poison.strike(WORK)
    poison.check(WORK)
    poison.strike(WORK)
    clock.now_s = 599.0
    with pytest.raises(UnavailableError) as refused:
        poison.check(WORK)
    assert refused.value.retry_after_s == 1.0
    clock.now_s = 600.0
    poison.check(WORK)


def test_another_format_of_the_table_is_another_work() -> None:
    """What one format's writer does is not held against the other's; a stem makes no difference."""
    poison = Poison()
    poison.strike(WORK)
    poison.strike(WORK)
    poison.check(film_work(form=FormatName.NPZ))
    poison.check(film_work(421.0))
    with pytest.raises(UnavailableError):
        poison.check(film_work())


def test_a_work_that_is_done_is_forgiven() -> None:
    """A worker that was killed from outside between two successes leaves no trace."""
    poison = Poison()
    for _ in range(5):
        poison.strike(WORK)
        poison.forgive(WORK)
    poison.check(WORK)


def test_old_strikes_are_forgotten() -> None:
    """A strike counts for ten minutes; what is remembered does not grow for ever."""
    clock = Clock()
    poison = Poison(clock=clock)
    poison.strike(WORK)
    clock.now_s = 601.0
    poison.strike(film_work(500.0))
    poison.strike(WORK)
    poison.check(WORK)
    assert len(poison._records) == 2
