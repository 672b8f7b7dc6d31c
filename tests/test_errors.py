"""Messages are for people: sizes in a unit that has digits, failures without a number of the system."""

import errno
import os

import pytest

from nacreous.errors import BudgetError, reason


@pytest.mark.parametrize(
    ("limit_bytes", "expected"), [(1000, "1000 bytes"), (3072, "3.0 KiB"), (5 * 2**20, "5.0 MiB")]
)
def test_a_small_budget_is_not_shown_as_nothing(limit_bytes: int, expected: str) -> None:
    """1 KiB is 1,024 bytes (IEC 80000-13)."""
    assert f"the limit is {expected};" in str(BudgetError("a table", 10**9, limit_bytes))


def test_a_reason_is_words() -> None:
    """POSIX's strerror where there is one, else the text of the error."""
    assert reason(OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "film.exr")) == "No space left on device"
    assert reason(ValueError("embedded null byte")) == "embedded null byte"
