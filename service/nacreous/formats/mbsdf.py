"""``mbsdf``: an isotropic bsdf with its transmission in linear colours, for hosts of NVIDIA's MDL.

``film.mbsdf`` is what ``bsdf_measurement("film.mbsdf")`` loads for MDL's ``df::measured_bsdf``: lines of
text, then one block or two of numbers, little endian.

================================  ============================================================================
``NVIDIA ARC MBSDF V1``           the first line
``NACREOUS=…``                    provenance: JSON in ASCII, cut into lines; readers skip whatever stands here
``MBSDF_DATA_REFLECTION=``        the line before the first block
u32 1, u32 N, u32 2 N             three numbers a value; resolution of theta and of phi
f32 N x N x 2 N x 3               f in 1 / sr, without the cosine, at theta_in, theta_out and phi, in colours
``MBSDF_DATA_TRANSMISSION=``      the same of light that arrives from behind, where the substrate transmits
================================  ============================================================================

theta_in is the angle of the arriving light and theta_out that of the eye, which is always in front; phi is
the azimuth between them, 0 to 180 degrees, a mirror at 180; values lie in the middles of equal bins
(`nacreous.tables.measured.mbsdf`). Layout, order and middles are those of the MDL SDK:
`ibsdf_isotropic_data.h`, and the volume texture of its examples.

The SDK's examples take the mean of f and of f with its angles exchanged. Reflection is the same either way.
Transmission into a denser substrate is not: they see it at both angles, half as bright. A host that reads the
file as it stands has it right. Colours are those of the spec's space. Refused are several roughnesses,
anisotropic surfaces, and a roughness below 0.05, whose lobe is narrower than the grid. Files are of 3 to
48 MB.
"""

import os
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import FileFormatError, reason
from nacreous.formats.atomic import replacing
from nacreous.formats.carried_text import contents_of, sealed
from nacreous.formats.contents import Contents
from nacreous.formats.lookup import colour_facts, required
from nacreous.formats.rgl import NARROW
from nacreous.tables.measured.surface import (
    check_isotropic,
    check_least_alpha,
    check_one_roughness,
    check_rgb,
)
from nacreous.tables.sampling import Sampling
from nacreous.tables.spec import Spec
from nacreous.tables.table import Table

__all__ = ["SUFFIX", "check", "read", "write"]

SUFFIX = ".mbsdf"
LEAST_ALPHA = 0.05
_MAGIC = b"NVIDIA ARC MBSDF V1\n"
_PROVENANCE, _WIDTH = b"NACREOUS=", 500
_BLOCKS = {"f_r_rgb": b"MBSDF_DATA_REFLECTION=\n", "f_t_rgb": b"MBSDF_DATA_TRANSMISSION=\n"}
_RGB = 1
"""Type of a block of three numbers a value."""


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write `table` and return the file; raises `FileFormatError`."""
    required(table, "f_r_rgb")
    blocks = {name: table.values(name).astype("<f4") for name in _BLOCKS if name in table.variables}
    text = sealed(blocks, {**table.provenance, **colour_facts(table.spec.colour)}).encode()
    with replacing(path) as (temporary,), temporary.open("xb") as file:
        file.write(_MAGIC)
        for start in range(0, len(text), _WIDTH):
            file.write(_PROVENANCE + text[start : start + _WIDTH] + b"\n")
        for name, values in blocks.items():
            theta, _, phi, _ = values.shape
            file.write(_BLOCKS[name] + struct.pack("<3I", _RGB, theta, phi))
            file.write(np.ascontiguousarray(values).data)
    return (path,)


def read(path: Path) -> Contents:
    """Return the blocks, (theta_o, theta_i, phi, 3), and the provenance; raises `FileFormatError`."""
    try:
        with path.open("rb") as file:
            if file.readline() != _MAGIC:
                raise ValueError("it does not begin with NVIDIA ARC MBSDF V1")  # noqa: TRY301 - as the others
            text, line = _text(file)
            blocks = dict(_blocks(file, line))
        return contents_of(blocks, text, Sampling.MBSDF)
    except (OSError, ValueError, struct.error) as error:
        raise FileFormatError(
            f"expected a measured BSDF of MDL, written by Nacreous, got one that cannot be read: "
            f"{reason(error)}"
        ) from error


def _text(file: BinaryIO) -> tuple[str, bytes]:
    """Return the provenance, and the first line after the metadata."""
    pieces: list[bytes] = []
    for line in file:
        if line in _BLOCKS.values():
            return b"".join(pieces).decode("ascii"), line
        if line.startswith(_PROVENANCE):
            pieces.append(line.removeprefix(_PROVENANCE).removesuffix(b"\n"))
    raise ValueError("it has no data")


def _blocks(file: BinaryIO, line: bytes) -> Iterator[tuple[str, NDArray[np.float32]]]:
    names = {head: name for name, head in _BLOCKS.items()}
    while line:
        if line not in names:
            raise ValueError("something else follows its data")
        kind, theta, phi = struct.unpack("<3I", file.read(12))
        if kind != _RGB:
            raise ValueError("its values are no colours")
        size = theta * theta * phi * 12
        if size > os.fstat(file.fileno()).st_size - file.tell():
            raise ValueError("it ends within its data")
        data = file.read(size)
        yield names[line], np.frombuffer(data, "<f4").reshape(theta, theta, phi, 3)
        line = file.readline()


def check(spec: Spec) -> None:
    """Refuse a spec whose meaning the file would lose; raises `SpecError` with what holds it."""
    check_one_roughness(spec, "mbsdf")
    check_isotropic(spec, "mbsdf", "rgl-rgb")
    check_rgb(spec, "mbsdf")
    check_least_alpha(spec, "mbsdf", LEAST_ALPHA, NARROW)
