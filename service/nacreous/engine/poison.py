"""Works that have ended their worker are remembered, and refused for a while without being run again."""

import time
from collections.abc import Callable
from dataclasses import dataclass, field

from nacreous.engine.work import Work
from nacreous.errors import UnavailableError

__all__ = ["Poison"]

_STRIKES = 2


@dataclass
class _Record:
    strikes: int
    until: float


@dataclass
class Poison:
    """How often each work has cost a worker since it was last done.

    Parameters
    ----------
    seconds : float
        How long a strike is remembered, and a work of two strikes refused.
    clock : callable
        Seconds that only ever increase.
    """

    seconds: float = 600.0
    clock: Callable[[], float] = time.monotonic
    _records: dict[tuple[str, str], _Record] = field(default_factory=dict)

    def check(self, work: Work) -> None:
        """Raise `UnavailableError` for a work that has cost two workers."""
        record = self._records.get(_key(work))
        left_s = record.until - self.clock() if record else 0.0
        if record and record.strikes >= _STRIKES and left_s > 0:
            raise UnavailableError(
                f"this table has ended its worker {record.strikes} times, and is refused "
                f"for {left_s / 60:.0f} more minutes; simplify it, or report it",
                left_s,
            )

    def strike(self, work: Work) -> None:
        """Remember that a work has cost a worker."""
        now = self.clock()
        self._records = {key: record for key, record in self._records.items() if record.until > now}
        before = self._records.get(_key(work))
        self._records[_key(work)] = _Record(before.strikes + 1 if before else 1, now + self.seconds)

    def forgive(self, work: Work) -> None:
        """Forget a work's strikes: it has been done."""
        self._records.pop(_key(work), None)


def _key(work: Work) -> tuple[str, str]:
    return work.id, work.format
