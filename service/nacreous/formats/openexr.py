"""The rules for every EXR: one scan-line part of float32, ZIP, and no word about primaries.

* One part: Blender 4.5 and 5.2 load files of several parts as size 0.
* ZIP is exact and read by all; ZSTD and HTJ2K are unreadable for most, DWA and B44 change the values.
* No ``chromaticities``: with them Mitsuba converts the pixels even of data that is marked raw.

Nacreous writes attributes as text; OpenEXR keeps them byte for byte. The attribute ``nacreous:checksum`` is
over the channels, by their names, and the other attributes of Nacreous.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import FileFormatError
from nacreous.formats.contents import CHECKSUM, checksum, provenance_of
from nacreous.tables.digest import array_bytes

__all__ = ["read_part", "write_part"]


def write_part(
    path: Path, channels: Mapping[str, NDArray[np.float32]], attributes: Mapping[str, str | float]
) -> None:
    """Write one part.

    Parameters
    ----------
    path : Path
    channels : mapping of str to array, each (H, W)
        An EXR keeps its channels in the order of their names.
    attributes : mapping of str to str or float

    Raises
    ------
    OSError
        The file cannot be written, or does not hold what was written.
    """
    import OpenEXR

    planes = {name: np.ascontiguousarray(plane, np.float32) for name, plane in channels.items()}
    sealed = {**attributes, CHECKSUM: checksum(attributes.items(), array_bytes(planes))}
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage, **sealed}
    try:
        with OpenEXR.File(header, dict(planes)) as file:  # a copy: the binding changes what it is given
            file.write(str(path))
    except RuntimeError as error:  # 'Failed to write pixel data to image file "…". File too large.'
        raise OSError(str(error).rpartition('". ')[2]) from error
    _check_written(path, planes)


def _check_written(path: Path, planes: Mapping[str, NDArray[np.float32]]) -> None:
    """Read a file again: OpenEXR says nothing of a disk that was full when it closed the file."""
    try:
        stored, _, _ = read_part(path)
    except FileFormatError as error:
        raise OSError("the disk has not kept what was written") from error
    if not all(np.array_equal(stored[name], plane, equal_nan=True) for name, plane in planes.items()):
        raise OSError("the disk has not kept what was written")


def read_part(path: Path) -> tuple[dict[str, NDArray[Any]], dict[str, str], str]:
    """Return the channels, each (H, W), of a file's only part, its provenance and the checksum over both.

    Raises
    ------
    FileFormatError
        The file is no EXR of one part.
    """
    import OpenEXR

    try:
        with OpenEXR.File(str(path), separate_channels=True) as file:
            if len(file.parts) != 1:
                raise FileFormatError(f"expected an EXR of one part, got {len(file.parts)}")
            channels = {name: np.array(channel.pixels) for name, channel in file.channels().items()}
            attributes = dict(file.header())
    except (RuntimeError, ValueError, TypeError) as error:  # what the binding makes of a damaged file
        raise FileFormatError(f"expected an EXR, got one that cannot be read: {error}") from error
    provenance = provenance_of(attributes.items())
    return channels, provenance, checksum(attributes.items(), array_bytes(channels))
