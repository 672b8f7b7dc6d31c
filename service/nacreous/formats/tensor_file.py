"""The tensor file: named arrays in one binary file, which Mitsuba 3, pbrt-v4, Falcor and powitacq read.

Little endian: the bytes ``tensor_file`` and a zero, the version 1.0 as two bytes, the number of fields (u32);
for each field the length of its name (u16), the name, the number of dimensions (u16), the type (u8), the
offset of its data from the start of the file (u64) and its shape (u64 each); then the data, each array at a
multiple of 8 bytes.

Readers ask for fields by name and ignore others. Provenance is in further fields of text, ``nacreous:id`` and
the rest; ``nacreous:checksum`` is over everything else.
"""

import struct
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import FileFormatError, reason
from nacreous.formats.atomic import replacing
from nacreous.formats.contents import CHECKSUM, PREFIX, Contents, checksum, labelled, provenance_of
from nacreous.tables.digest import array_bytes
from nacreous.tables.sampling import Sampling

__all__ = ["read_tensors", "text", "write_tensors"]

_MAGIC = b"tensor_file\0\x01\x00"
_TYPES: Mapping[int, str] = MappingProxyType(
    {
        1: "<u1",
        2: "<i1",
        3: "<u2",
        4: "<i2",
        5: "<u4",
        6: "<i4",
        7: "<u8",
        8: "<i8",
        9: "<f2",
        10: "<f4",
        11: "<f8",
    }
)
_CODES = MappingProxyType({np.dtype(name): code for code, name in _TYPES.items()})
_ALIGNMENT = 8


def text(value: str) -> NDArray[np.uint8]:
    """Return a text as a field holds it."""
    return np.frombuffer(value.encode(), np.uint8)


def write_tensors(path: Path, fields: Mapping[str, NDArray[Any]], provenance: Mapping[str, str]) -> None:
    """Write arrays in the order given, and provenance; raises `FileFormatError`."""
    labels = labelled(provenance)
    labels[CHECKSUM] = checksum(labels.items(), array_bytes(dict(fields)))
    everything = {**fields, **{name: text(value) for name, value in labels.items()}}
    stored = {
        name: np.ascontiguousarray(values, values.dtype.newbyteorder("<"))
        for name, values in everything.items()
    }
    with replacing(path) as (temporary,), temporary.open("xb") as file:
        file.writelines(_encoded(stored))


def _encoded(stored: Mapping[str, NDArray[Any]]) -> Iterator[bytes | memoryview]:
    """Yield a file's bytes, piece by piece."""
    head = _head(stored)
    yield head
    at = len(head)
    for values in stored.values():
        yield b"\0" * (-at % _ALIGNMENT)
        yield values.data
        at += -at % _ALIGNMENT + values.nbytes


def _head(stored: Mapping[str, NDArray[Any]]) -> bytes:
    """Return everything before the data."""
    names = {name: name.encode() for name in stored}
    size = len(_MAGIC) + 4 + sum(2 + len(names[name]) + 11 + 8 * stored[name].ndim for name in stored)
    head, offset = [_MAGIC, struct.pack("<I", len(stored))], size
    for name, values in stored.items():
        offset += -offset % _ALIGNMENT
        head += [struct.pack("<H", len(names[name])), names[name]]
        head += [struct.pack("<HBQ", values.ndim, _CODES[values.dtype], offset)]
        head += [struct.pack(f"<{values.ndim}Q", *values.shape)]
        offset += values.nbytes
    return b"".join(head)


def read_tensors(path: Path, sampling: Sampling) -> Contents:
    """Return the arrays and the provenance; raises `FileFormatError`."""
    try:
        data = path.read_bytes()
        fields = dict(_field(data, start) for start in _starts(data))
        if b"".join(_encoded(fields)) != data:
            raise ValueError("something stands between or after its fields")  # noqa: TRY301 - as the others
    except (OSError, struct.error, ValueError, KeyError, UnicodeDecodeError) as error:
        raise FileFormatError(
            f"expected a tensor file, got one that cannot be read: {reason(error)}"
        ) from error
    arrays = {name: values for name, values in fields.items() if not name.startswith(PREFIX)}
    labels = [(name, values.tobytes().decode()) for name, values in fields.items() if name.startswith(PREFIX)]
    return Contents(arrays, provenance_of(labels), checksum(labels, array_bytes(arrays)), sampling)


def _starts(data: bytes) -> list[int]:
    """Return where each field is described."""
    if not data.startswith(_MAGIC):
        raise ValueError("it does not begin with tensor_file, version 1.0")
    (count,) = struct.unpack_from("<I", data, len(_MAGIC))
    starts, at = [], len(_MAGIC) + 4
    for _ in range(count):
        starts.append(at)
        (length,) = struct.unpack_from("<H", data, at)
        (ndim,) = struct.unpack_from("<H", data, at + 2 + length)
        at += 2 + length + 11 + 8 * ndim
    return starts


def _field(data: bytes, start: int) -> tuple[str, NDArray[Any]]:
    (length,) = struct.unpack_from("<H", data, start)
    name = data[start + 2 : start + 2 + length].decode()
    ndim, code, offset = struct.unpack_from("<HBQ", data, start + 2 + length)
    shape = struct.unpack_from(f"<{ndim}Q", data, start + 2 + length + 11)
    count = int(np.prod(shape, dtype=object)) if shape else 1
    return name, np.frombuffer(data, _TYPES[code], count, offset).reshape(shape)
