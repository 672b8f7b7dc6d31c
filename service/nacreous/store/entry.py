"""An entry of the store: one file and what is known of it, in one object that shows every damage.

The object is a SHA-256 in hex, a line end, a line of JSON, and the file's bytes. The checksum is of the
entry's key, a line end, and all that follows the checksum's own line, so that a sound object under another's
name shows as well. One object is written or not, replaced or not, and read as a whole: there is no half of it
to be out of step.
"""

import hashlib
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self

from nacreous.errors import StoreError

__all__ = ["BEGINNING", "Entry", "begins_as_entry"]

_HEX_DIGITS = 64
_BODY = _HEX_DIGITS + 1
BEGINNING = _BODY + 1
"""How many bytes `begins_as_entry` wants to see."""


@dataclass(frozen=True)
class Entry:
    """A file in the store.

    Parameters
    ----------
    facts : mapping
        What is known of the file, fit for JSON: its media type, its table's id and certificate.
    payload : bytes
        The file.
    """

    facts: Mapping[str, Any]
    payload: bytes

    @cached_property
    def sha256(self) -> str:
        """SHA-256 of the file, in hex."""
        return hashlib.sha256(self.payload).hexdigest()

    def to_bytes(self, key: str) -> bytes:
        """Return the object that the store keeps under `key`."""
        facts = json.dumps(dict(self.facts), sort_keys=True, separators=(",", ":"), allow_nan=False)
        body = facts.encode() + b"\n" + self.payload
        return _checksum(key, body) + b"\n" + body

    @classmethod
    def from_bytes(cls, stored: bytes, key: str) -> Self:
        """Return the entry of an object; raises `StoreError` where a single bit of it is not as written.

        Examples
        --------
        >>> Entry.from_bytes(Entry({"id": "film"}, b"bytes").to_bytes("tables/film"), "tables/film")
        Entry(facts={'id': 'film'}, payload=b'bytes')
        """
        checksum, line_end, body = stored[:_HEX_DIGITS], stored[_HEX_DIGITS:_BODY], stored[_BODY:]
        if line_end != b"\n" or checksum != _checksum(key, body):
            raise StoreError("expected an entry with its own checksum, got one that has been damaged")
        facts, _, payload = body.partition(b"\n")
        return cls(json.loads(facts), payload)


def begins_as_entry(beginning: bytes) -> bool:
    """Return whether bytes look like the beginning of an object: a checksum in hex and a line of JSON."""
    return re.fullmatch(rb"[0-9a-f]{64}\n\{", beginning) is not None


def _checksum(key: str, body: bytes) -> bytes:
    digest = hashlib.sha256(key.encode() + b"\n")
    digest.update(body)
    return digest.hexdigest().encode()
