"""The attributes of an OpenEXR file, read without its pixels.

Blender opens EXR files, but shows none of their attributes to Python. A header is a magic number, a version
with flags, and attributes one after another, each a name, a type, a size and so many bytes; an empty name
ends it (OpenEXR, "OpenEXR File Layout"). All numbers are little endian.
"""

import struct
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

MAGIC = 20000630
DEEP_OR_MULTIPART = 0x800 | 0x1000
"""Flags of files in which more than one plain picture may lie."""
NAME_BYTES = 255
"""Longest name of an attribute or type: the layout's limit for files with long names."""
HEADER_BYTES = 16 * 2**20
"""More than any spec takes, and little enough to read at once."""


class NotAPictureError(ValueError):
    """The file is no OpenEXR file of one part."""


def text_attributes(path: Path) -> dict[str, str]:
    """Return the attributes of type ``string``; raises `NotAPictureError` and `OSError`.

    The file must be whole, and made of scan lines.
    """
    with path.open("rb") as file:
        magic, version = struct.unpack("<ii", _exactly(file, 8))
        if magic != MAGIC:
            raise NotAPictureError("it does not begin as an OpenEXR file does")
        if version & DEEP_OR_MULTIPART:
            raise NotAPictureError("it is a deep or multi-part OpenEXR file")
        attributes = dict(_strings(file))
        _require_all_lines(file)
        return attributes


def _strings(file: BinaryIO) -> Iterator[tuple[str, str]]:
    while name := _name(file):
        kind = _name(file)
        (size,) = struct.unpack("<i", _exactly(file, 4))
        if not 0 <= size <= HEADER_BYTES - file.tell():
            raise NotAPictureError(f"its attribute {name!r} claims {size} bytes")
        value = _exactly(file, size)
        if kind == "string":
            yield name, value.decode("utf-8", errors="replace")


def _require_all_lines(file: BinaryIO) -> None:
    """Follow the table of offsets to the last lines: Blender shows a file that is cut short as black there.

    The first lines begin where the table ends, each with their place and size, in files of scan lines.
    """
    begin = file.tell()
    (first,) = offset = struct.unpack("<Q", _exactly(file, 8))
    count = (first - begin) // 8
    if not 0 < count <= HEADER_BYTES // 8:
        raise NotAPictureError("its lines are not in order")
    offsets = offset + struct.unpack(f"<{count - 1}Q", _exactly(file, 8 * (count - 1)))
    file.seek(max(offsets))
    _, size = struct.unpack("<ii", _exactly(file, 8))
    _exactly(file, min(max(size, 0), HEADER_BYTES))


def _name(file: BinaryIO) -> str:
    """Read bytes up to a zero."""
    name = bytearray()
    while (byte := _exactly(file, 1)) != b"\0":
        name += byte
        if len(name) > NAME_BYTES:
            raise NotAPictureError("its header has a name without an end")
    return name.decode("utf-8", errors="replace")


def _exactly(file: BinaryIO, count: int) -> bytes:
    found = file.read(count)
    if len(found) < count:
        raise NotAPictureError("it ends too early")
    return found
