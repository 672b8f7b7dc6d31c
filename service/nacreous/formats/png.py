"""``png``: the lookup texture as a picture to look at, 8-bit sRGB, clipped to the gamut.

Axes and files are those of the `exr` format. Text chunks carry the provenance, and
``nacreous:gamut.outside``, the share of texels that clipping has changed. It is a picture, not data: 8 bits
band, and a shader wants the linear values of the EXR. Lobes of a BSDF are clipped where they are brighter
than 1 / sr.
"""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import FileFormatError
from nacreous.formats.atomic import replacing
from nacreous.formats.contents import CHECKSUM, PREFIX, Contents, checksum, provenance_of
from nacreous.formats.lookup import coloured_names, colours, lookup_attributes, lookup_files
from nacreous.formats.srgb import encoded, out_of_gamut
from nacreous.tables.digest import array_bytes
from nacreous.tables.rec709 import rec709
from nacreous.tables.table import Table

__all__ = ["SUFFIX", "read", "write"]

SUFFIX = ".png"

_PERCEPTUAL = b"\x00"
"""Rendering intent of the sRGB chunk (W3C PNG, section 11.3.2.5)."""


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write the colours of `table` and return the files; raises `FileFormatError`."""
    files, obsolete = lookup_files(table, path, SUFFIX, coloured_names(table), read)
    with replacing(*files.values(), obsolete=obsolete) as temporaries:
        for name, temporary in zip(files, temporaries, strict=True):
            _write_picture(table, name, temporary)
    return tuple(files.values())


def _write_picture(table: Table, name: str, path: Path) -> None:
    from PIL import Image
    from PIL.PngImagePlugin import PngInfo

    linear = rec709(colours(table, name), table.spec.colour)  # (H, W, 3)
    texts = lookup_attributes(table, name) | {f"{PREFIX}gamut.outside": f"{out_of_gamut(linear):.4f}"}
    pixels = encoded(linear)
    chunks = PngInfo()
    chunks.add(b"sRGB", _PERCEPTUAL)
    for key, text in {**texts, CHECKSUM: _checksum(texts, pixels)}.items():
        chunks.add_text(key, text)
    Image.fromarray(pixels).save(path, format="PNG", pnginfo=chunks)


def _checksum(texts: Mapping[str, str], pixels: NDArray[np.uint8]) -> str:
    return checksum(texts.items(), array_bytes({"pixels": pixels}))


def read(path: Path) -> Contents:
    """Return the picture, (H, W, 3) of bytes, and the text chunks; raises `FileFormatError`."""
    from PIL import Image

    try:
        with Image.open(path, formats=["PNG"]) as picture:
            picture.load()
            texts, pixels = dict(picture.text), np.asarray(picture)  # type: ignore[attr-defined]
    except (OSError, SyntaxError, ValueError) as error:  # SyntaxError: a broken chunk
        raise FileFormatError(f"expected a PNG, got one that cannot be read: {error}") from error
    provenance = provenance_of(texts.items())
    return Contents({f"{provenance.get('quantity', 'R')}_srgb": pixels}, provenance, _checksum(texts, pixels))
