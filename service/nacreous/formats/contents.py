"""What a table's file holds once it is read again."""

import struct
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from nacreous.errors import FileFormatError, reason
from nacreous.tables.digest import digest
from nacreous.tables.sampling import Sampling

__all__ = ["CHECKSUM", "PREFIX", "Contents", "checksum", "labelled", "provenance_of", "reading"]

PREFIX = "nacreous:"
"""Begins the name of every attribute that Nacreous writes, in every format."""

CHECKSUM = f"{PREFIX}checksum"
"""The attribute that holds `checksum`."""


_UNREADABLE = (
    ArithmeticError,
    AttributeError,
    EOFError,
    LookupError,
    MemoryError,
    OSError,
    RuntimeError,
    TypeError,
    ValueError,
    struct.error,
)
"""What parsers, ours and others', make of damaged bytes: an offset of 2^63, a document nested 20,000 deep."""


@contextmanager
def reading(what: str) -> Iterator[None]:
    """Say of whatever a reader raises over a damaged file that `what` was expected: `FileFormatError`."""
    try:
        yield
    except _UNREADABLE as error:
        raise FileFormatError(
            f"expected {what}, got one that cannot be read: {reason(error) or type(error).__name__}"
        ) from error


@dataclass(frozen=True, eq=False)
class Contents:
    """Arrays and provenance of one file.

    Parameters
    ----------
    arrays : mapping of str to array
        Every quantity of the file: ``R_s`` … ``T_p``, ``R`` and ``T`` for unpolarised spectra, ``R_rgb`` and
        ``T_rgb`` for colours; and the axes, where the file holds them as arrays.
    provenance : mapping of str to str
        ``id``, ``version``, ``spec``, ``certificate`` and the rest, without their prefix.
    checksum : str
        What `checksum` gives for the file as it is; ``provenance["checksum"]`` is what it was.
    sampling : Sampling
        Where the table of the file is sampled.
    """

    arrays: Mapping[str, NDArray[Any]]
    provenance: Mapping[str, str]
    checksum: str
    sampling: Sampling = Sampling.AXES


def checksum(attributes: Iterable[tuple[str, object]], values: Iterable[bytes]) -> str:
    """Return the SHA-256, in hex, over the values as a file stores them and Nacreous's other attributes."""
    ours = {key: str(value) for key, value in attributes if key.startswith(PREFIX) and key != CHECKSUM}
    return digest(ours, values)


def labelled(provenance: Mapping[str, str]) -> dict[str, str]:
    """Return `provenance` under the names that files give it, such as ``nacreous:id``."""
    return {f"{PREFIX}{key}": value for key, value in provenance.items()}


def provenance_of(attributes: Iterable[tuple[str, object]]) -> dict[str, str]:
    """Return what `labelled` wrote, from all the attributes of a file."""
    return {key.removeprefix(PREFIX): str(value) for key, value in attributes if key.startswith(PREFIX)}
