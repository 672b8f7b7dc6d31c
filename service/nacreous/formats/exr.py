"""``exr``: the lookup texture for renderers, RGB in float32.

``film.exr`` holds the linear colour of what is reflected, R, E_r or f_r, and ``film.transmission.exr`` that
of what is transmitted, T, E_t or f_t, where the substrate transmits. `nacreous.formats.atlas` has the axes,
`nacreous.formats.openexr` the rules of the file. Colours in the CIE's XYZ are stored in channels X, Y and Z;
all others in R, G and B, of the space that the attribute ``nacreous:colour.space`` names.

Load it as data (raw, non-colour), with linear filtering, clamped at the edges and without mip levels. Values
below 0, and shares above 1, are colours outside of the space's gamut: they belong to the table.

========================  ==================================================================================
``nacreous:quantity``     ``R`` or ``T``, ``E_r`` or ``E_t``, ``f_r`` or ``f_t``
``nacreous:axis.x``       JSON: name, unit, range, count and mapping of the columns
``nacreous:axis.y``       the same of the rows, from the top
``nacreous:tiles.x``      JSON, where tiles lie side by side: their axes, number, and columns of each
``nacreous:tiles.y``      the same of tiles one below the other, and rows of each
``nacreous:colour.…``     ``space``, ``illuminant`` and ``observer``
``nacreous:id``           SHA-256 over everything that decides the values
``nacreous:spec``         the spec, complete but for its labels, as JSON
``nacreous:certificate``  the errors measured between the texels, as JSON
``nacreous:checksum``     SHA-256 over the channels and all other attributes of Nacreous
``nacreous:version``      of Nacreous; ``precision``, ``device`` and ``kernels`` say how it was computed
========================  ==================================================================================
"""

from pathlib import Path

import numpy as np

from nacreous.errors import FileFormatError
from nacreous.formats.atomic import replacing
from nacreous.formats.contents import Contents
from nacreous.formats.lookup import coloured_names, colours, lookup_attributes, lookup_files
from nacreous.formats.openexr import read_part, write_part
from nacreous.tables.table import Table

__all__ = ["SUFFIX", "read", "write"]

SUFFIX = ".exr"


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write the colours of `table` and return the files; raises `FileFormatError`."""
    files, obsolete = lookup_files(table, path, SUFFIX, coloured_names(table), read)
    with replacing(*files.values(), obsolete=obsolete) as temporaries:
        for name, temporary in zip(files, temporaries, strict=True):
            texels = colours(table, name)  # (H, W, 3)
            channels = {key: texels[..., at] for at, key in enumerate(table.values("channel").tolist())}
            write_part(temporary, channels, lookup_attributes(table, name))
    return tuple(files.values())


def read(path: Path) -> Contents:
    """Return the colours, (H, W, 3), and the attributes; raises `FileFormatError`."""
    channels, provenance, found = read_part(path)
    names = next((names for names in ("RGB", "XYZ") if set(names) == channels.keys()), None)
    if names is None:
        raise FileFormatError(f"expected the channels R, G, B or X, Y, Z, got {', '.join(channels)}")
    texels = np.stack([channels[name] for name in names], axis=-1)
    return Contents({f"{provenance.get('quantity', 'R')}_rgb": texels}, provenance, found)
