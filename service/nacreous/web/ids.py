"""Ids in a path: 64 lower-case hex digits, and nothing else comes near the store."""

import re

from nacreous.errors import MissingError
from nacreous.optics.value import shown

__all__ = ["checked_id"]

_ID = re.compile(r"[0-9a-f]{64}")


def checked_id(text: str, what: str) -> str:
    """Return an id, or raise `MissingError`: `what`, such as ``"table"``, cannot have such a one."""
    if _ID.fullmatch(text) is None:
        raise MissingError(f"expected the id of a {what}, 64 lower-case hex digits, got {shown(text)}")
    return text
