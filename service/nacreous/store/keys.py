"""Names of entries: parts with slashes between them, such as ``tables/ab/ab12.exr``.

A key names nothing outside the store and nothing hidden in it, whatever it is made from.
"""

import re

__all__ = ["QUARANTINE", "check_key", "check_prefix", "is_key"]

QUARANTINE = "quarantine"
"""Where damaged objects go; no key begins with it."""

_PART = r"[A-Za-z0-9_-][A-Za-z0-9_.-]{0,254}"
"""A name that every file system takes (NAME_MAX of Linux) and that is not hidden."""
_KEY = re.compile(rf"(?!{QUARANTINE}(?:/|\Z)){_PART}(?:/{_PART})*", re.ASCII)
_LONGEST = 1024
"""Of a key on S3 (Amazon S3 user guide, object key names)."""


def is_key(text: str) -> bool:
    """Return whether an entry may have this name.

    Examples
    --------
    >>> is_key("tables/ab/ab12.exr"), is_key("../secret"), is_key("tables/.hidden")
    (True, False, False)
    """
    return len(text) <= _LONGEST and _KEY.fullmatch(text) is not None


def check_key(key: str) -> None:
    """Raise `ValueError` where no entry may have this name."""
    if not is_key(key):
        raise ValueError(
            "expected a key of letters, digits and -_. in parts with / between, none beginning with a dot, "
            f"got {key!r}"
        )


def check_prefix(prefix: str) -> None:
    """Raise `ValueError` where no key begins with this; every key begins with the empty one."""
    if prefix and not is_key(prefix.removesuffix("/")):
        raise ValueError(f"expected the beginning of a key, got {prefix!r}")
