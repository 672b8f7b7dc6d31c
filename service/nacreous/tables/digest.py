"""One number for arrays and the facts about them: SHA-256 over a form that no file format changes."""

import hashlib
import json
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["array_bytes", "digest"]


def digest(facts: Mapping[str, str], values: Iterable[bytes]) -> str:
    """Return the SHA-256, in hex, over `facts`, in the order of their names, and then over `values`."""
    running = hashlib.sha256(_json(dict(facts)))
    for part in values:
        running.update(part)
    return running.hexdigest()


def array_bytes(arrays: Mapping[str, NDArray[Any]]) -> Iterator[bytes]:
    """Yield what tells arrays apart, in the order of their names: name, type, shape and values.

    Numbers are little-endian and in C order. Text is JSON, because every format has its own type for it.
    """
    for name, array in sorted(arrays.items()):
        if array.dtype.kind in "biufc":
            stored = np.ascontiguousarray(array, array.dtype.newbyteorder("<"))
            yield _json([name, stored.dtype.str, array.shape])
            yield stored.tobytes()
        else:
            text = array if array.dtype.kind == "T" else array.astype(str)  # NumPy casts no "T" to it
            yield _json([name, "text", array.shape, text.ravel().tolist()])


def _json(value: object) -> bytes:
    return json.dumps(value, sort_keys=True, separators=(",", ":")).encode()
