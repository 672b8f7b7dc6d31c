"""Output that a page shows, compared with what was printed.

A page shows it loosely. `…` stands for anything within a line, and for any number of lines where it is a line
of its own. White space counts as one space. Whole numbers and words are as printed; a number with a point may
be off by one in the last digit that is shown, because devices round differently.
"""

import re
from collections.abc import Sequence

__all__ = ["fault"]

ELLIPSIS = "…"
_NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.]*\d)")
_PRINTED_NUMBER = r"(-?\d+(?:\.\d+)?(?:e[-+]?\d+)?)"


def fault(shown: str, printed: str) -> str:
    """Say which shown line was not printed where it should have been; empty if all were."""
    lines, at, may_skip = [line for line in printed.splitlines() if line.strip()], 0, False
    for line in shown.splitlines():
        if line.strip() == ELLIPSIS:
            may_skip = True
        elif line.strip():
            found = _position(line, lines, at, range(len(lines)) if may_skip else range(at, at + 1))
            if found is None:
                return f"expected {line!r} after line {at}, got\n{printed}"
            at, may_skip = found + 1, False
    return "" if may_skip or at == len(lines) else f"not shown: {lines[at]!r}"


def _position(line: str, printed: Sequence[str], first: int, places: range) -> int | None:
    """Return which of the printed lines from `first` on, at one of the places, is the shown one."""
    return next((at for at in places if first <= at < len(printed) and _is_shown(line, printed[at])), None)


def _is_shown(shown: str, printed: str) -> bool:
    """Tell whether a shown line stands for a printed one."""
    numbers = _NUMBER.findall(shown)
    match = re.fullmatch(_pattern(shown), printed.strip())
    return match is not None and all(map(_agree, numbers, match.groups()))


def _pattern(shown: str) -> str:
    """Return an expression for printed lines, with a group for each number."""
    words = (re.escape(word) for word in _NUMBER.split(shown.strip()))
    text = _PRINTED_NUMBER.join(words)
    return re.sub(r"(?:\\\s|\s)+", r"\\s+", text).replace(ELLIPSIS, ".*?")


def _agree(shown: str, printed: str) -> bool:
    """Tell whether numbers are equal: whole ones exactly, others within one of the last digit shown."""
    mantissa, _, exponent = shown.partition("e")
    _, point, decimals = mantissa.partition(".")
    step = 10.0 ** (int(exponent or 0) - len(decimals)) if point else 0.0
    return abs(float(shown) - float(printed)) <= 1.001 * step
