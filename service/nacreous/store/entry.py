"""An entry of the store: one file and what is known of it, in one object that shows every damage.

The object is the SHA-256, in hex, of all that follows it, a line end, a line of JSON, and the file's bytes.
One object is written or not, replaced or not, and read as a whole: there is no half of it to be out of step.
"""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self

from nacreous.errors import StoreError

__all__ = ["Entry"]

_HEX_DIGITS = 64


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

    def to_bytes(self) -> bytes:
        """Return the object that the store keeps."""
        facts = json.dumps(dict(self.facts), sort_keys=True, separators=(",", ":"), allow_nan=False)
        body = facts.encode() + b"\n" + self.payload
        return hashlib.sha256(body).hexdigest().encode() + b"\n" + body

    @classmethod
    def from_bytes(cls, stored: bytes) -> Self:
        """Return the entry of an object; raises `StoreError` where a single bit of it is not as written.

        Examples
        --------
        >>> Entry.from_bytes(Entry({"id": "film"}, b"bytes").to_bytes())
        Entry(facts={'id': 'film'}, payload=b'bytes')
        """
        checksum, body = stored[:_HEX_DIGITS], stored[_HEX_DIGITS + 1 :]
        if hashlib.sha256(body).hexdigest().encode() != checksum or stored[_HEX_DIGITS:][:1] != b"\n":
            raise StoreError("expected an entry with its own checksum, got one that has been damaged")
        facts, _, payload = body.partition(b"\n")
        return cls(json.loads(facts), payload)
