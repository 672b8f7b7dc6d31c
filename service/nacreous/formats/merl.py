"""``merl``: an isotropic bsdf in linear colours as the MERL database has it, for whatever reads that.

``film.binary`` is three i32, 90, 90 and 180, and then planes of f64 for red, green and blue, theta_h slowest
and phi_d fastest; little endian, 34,992,012 bytes. A number times 1 / 1500, 1.15 / 1500 or 1.66 / 1500 is f
in 1 / sr. `nacreous.tables.measured.merl` says where the bins are. The database's reader takes a bin's value,
which is that in its middle, and its error, which the certificate states, is the width of the bins: a few per
cent of f along a lobe. Readers that interpolate should take the middles for nodes, and have less.

Colours are those of the spec's space; readers expect Rec.709. A component below 0, of a colour that the space
has not, is written as 0, since the database marks bins without a value by negative numbers.

The layout has no room for attributes, and nothing may follow the planes: some readers take all that a file
has. But light above the surface never reaches a quarter of the bins, and readers take any negative number
there for no value. These numbers carry the provenance, six bytes each: red's bins first, in the order of the
file, -1 - v / 2^48 each. The first v is the length of a text, the others the text, JSON in ASCII, the first
byte least. Bins that are left are -1.

Refused are several roughnesses, transmitted light, anisotropic surfaces and roughnesses below 0.02.
"""

import struct
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import FileFormatError, reason
from nacreous.formats.atomic import replacing
from nacreous.formats.carried_text import contents_of, sealed
from nacreous.formats.contents import Contents
from nacreous.formats.lookup import colour_facts, required
from nacreous.formats.rgl import NARROW
from nacreous.tables.measured.merl import BINS, reached
from nacreous.tables.measured.surface import (
    check_isotropic,
    check_least_alpha,
    check_one_roughness,
    check_opaque,
    check_rgb,
)
from nacreous.tables.sampling import Sampling
from nacreous.tables.spec import Spec
from nacreous.tables.table import Table

__all__ = ["SUFFIX", "check", "read", "write"]

SUFFIX = ".binary"
LEAST_ALPHA = 0.02
SCALES = np.array([1.0, 1.15, 1.66]) / 1500
"""What readers multiply red, green and blue with."""
_HEAD = struct.pack("<3i", *BINS)
_SHAPE = (3, *BINS)
_BYTES, _UNIT = 6, 2.0**48
"""Bytes that one number carries, and what divides them."""


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write `table` and return the file; raises `FileFormatError`."""
    f = np.maximum(required(table, "rgb").astype(np.float64), 0) / SCALES
    planes = np.moveaxis(f, -1, 0).astype("<f8")
    planes[:, ~reached()] = -1
    text = sealed({"planes": planes}, {**table.provenance, **colour_facts(table.spec.colour)})
    _carry(planes, text.encode())
    with replacing(path) as (temporary,), temporary.open("xb") as file:
        file.write(_HEAD)
        file.write(np.ascontiguousarray(planes).data)
    return (path,)


def _carry(planes: NDArray[np.float64], text: bytes) -> None:
    """Put a text into the bins that no light reaches."""
    words = np.frombuffer(text + b"\0" * (-len(text) % _BYTES), np.uint8).reshape(-1, _BYTES)
    numbers = np.pad(words, ((0, 0), (0, 8 - _BYTES))).view("<u8")[:, 0]
    carried = -1 - np.concatenate([[len(text)], numbers]) / _UNIT
    free = np.broadcast_to(~reached(), _SHAPE)
    room = int(np.count_nonzero(free))
    if carried.size > room:
        raise FileFormatError("expected provenance that merl has room for, got too much")
    planes[free] = np.pad(carried, (0, room - carried.size), constant_values=-1)


def read(path: Path) -> Contents:
    """Return the planes, -1 where no light reaches, and the provenance; raises `FileFormatError`."""
    try:
        data = path.read_bytes()
        if not data.startswith(_HEAD):
            raise ValueError("it does not begin with 90, 90 and 180")  # noqa: TRY301 - told with the others
        planes = np.frombuffer(data, "<f8", offset=len(_HEAD)).reshape(_SHAPE).copy()
        text = _carried(planes)
        planes[:, ~reached()] = -1
        return contents_of({"planes": planes}, text, Sampling.MERL)
    except (OSError, ValueError) as error:
        raise FileFormatError(
            f"expected a file as of the MERL database, written by Nacreous, got one that cannot be read: "
            f"{reason(error)}"
        ) from error


def _carried(planes: NDArray[np.float64]) -> str:
    """Return the text that `_carry` put there."""
    free = planes[np.broadcast_to(~reached(), _SHAPE)]
    if not ((free > -2) & (free <= -1)).all():  # False for NaN, too
        raise ValueError("bins that no light reaches have values")
    numbers = ((-1 - free) * _UNIT).astype("<u8")
    words = numbers[1:, None].view(np.uint8)[:, :_BYTES].tobytes()
    length = int(numbers[0])
    if words[length:].strip(b"\0"):
        raise ValueError("bins that no light reaches have values")
    return words[:length].decode("ascii")


def check(spec: Spec) -> None:
    """Refuse a spec whose meaning the file would lose; raises `SpecError` with what holds it."""
    check_one_roughness(spec, "merl")
    check_isotropic(spec, "merl", "rgl-rgb")
    check_opaque(spec, "merl", "mbsdf")
    check_rgb(spec, "merl")
    check_least_alpha(spec, "merl", LEAST_ALPHA, NARROW)
