"""Bytes are counted before they are asked for: PoCL accepts more memory than a machine has, and is killed."""

import os
import re

from nacreous.errors import BudgetError, SpecError

__all__ = ["byte_budget", "require"]

_DEFAULT_BYTES = 2 * 2**30
_UNITS = {"": 1, "k": 2**10, "m": 2**20, "g": 2**30, "t": 2**40}


def byte_budget() -> int:
    """Bytes that a table and its buffers may take: ``NACREOUS_BYTE_BUDGET``, or 2 GiB.

    Raises
    ------
    SpecError
        The variable is not a number of bytes such as ``"500M"`` or ``"4 GiB"``.
    """
    text = os.environ.get("NACREOUS_BYTE_BUDGET", "")
    if not text:
        return _DEFAULT_BYTES
    match = re.fullmatch(r"([0-9]+)\s*([kmgt]?)(?:i?b)?", text.strip(), re.IGNORECASE)
    if not match or int(match[1]) == 0:
        raise SpecError("NACREOUS_BYTE_BUDGET", "a size such as 500M or 4GiB", repr(text))
    return int(match[1]) * _UNITS[match[2].lower()]


def require(what: str, needed_bytes: int) -> None:
    """Raise `BudgetError` where `what` needs more than the budget."""
    limit = byte_budget()
    if needed_bytes > limit:
        raise BudgetError(what, needed_bytes, limit)
