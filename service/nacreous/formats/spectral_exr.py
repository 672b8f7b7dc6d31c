"""``spectral-exr``: the spectrum of every texel in the layout of Fichet, Pacanowski and Wilkie.

A. Fichet, R. Pacanowski, A. Wilkie, "An OpenEXR Layout for Spectral Images", JCGT 10(3), 2021. Unpolarised
reflectance (R_s + R_p) / 2 is in one channel a wavelength, ``T.550,000000nm``, with the decimal comma that
the layout asks for. R, G and B are the preview; a table in XYZ, or beyond the visible, has none. Where the
substrate transmits, and always beyond the visible, the transmittance is in a second file,
``film.transmission.spectral.exr``. Axes are those of the lookup texture.

It is for spectral renderers and for analysis. **Blender 4.5 and 5.2 crash on a part of more than 24
channels**: give them the file of the `exr` format. An EXR sorts its channels by name, so wavelengths of
1,000 nm and more come before the shorter ones: go by the names, not by the order.
"""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import FileFormatError
from nacreous.formats.atomic import replacing
from nacreous.formats.contents import Contents
from nacreous.formats.lookup import colour_quantities, lookup_attributes, lookup_files, lookup_rows, required
from nacreous.formats.openexr import read_part, write_part
from nacreous.tables.table import Table

__all__ = ["SUFFIX", "read", "write"]

SUFFIX = ".spectral.exr"

_LAYER = "T."
"""Begins the name of a reflective or transmissive layer; emissive ones would be ``S0.``."""


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write the unpolarised spectra of `table` and return the files; raises `FileFormatError`."""
    files, obsolete = lookup_files(path, SUFFIX, _quantities(table), read)
    with replacing(*files.values(), obsolete=obsolete) as temporaries:
        for quantity, temporary in zip(files, temporaries, strict=True):
            layout: dict[str, str | float] = {"spectralLayoutVersion": "1.0", "EV": 0.0}
            attributes = {**lookup_attributes(table, quantity), **layout}
            write_part(temporary, _spectrum(table, quantity) | _preview(table, quantity), attributes)
    return tuple(files.values())


def _quantities(table: Table) -> tuple[str, ...]:
    return colour_quantities(table) if _has_colours(table) else ("R", "T")


def _has_colours(table: Table) -> bool:
    return "R_rgb" in table.variables


def _spectrum(table: Table, quantity: str) -> dict[str, NDArray[np.float32]]:
    s, p = (required(table, f"{quantity}_{polarisation}") for polarisation in "sp")
    rows = lookup_rows((s + p) / 2)  # (H, W, L)
    return {_channel(nm): rows[..., at] for at, nm in enumerate(table.values("wavelength_nm"))}


def _channel(wavelength_nm: float) -> str:
    number = f"{wavelength_nm:.6f}".replace(".", ",")
    return f"{_LAYER}{number}nm"


def _preview(table: Table, quantity: str) -> dict[str, NDArray[np.float32]]:
    if table.spec.colour.space == "XYZ" or not _has_colours(table):
        return {}
    rows = lookup_rows(required(table, f"{quantity}_rgb"))  # (H, W, 3)
    return {name: rows[..., channel] for channel, name in enumerate("RGB")}


def read(path: Path) -> Contents:
    """Return the spectra, (H, W, L), any preview, (H, W, 3), and the attributes; raises `FileFormatError`."""
    channels, provenance, found = read_part(path)
    layers = {_wavelength_nm(name): pixels for name, pixels in channels.items() if name.startswith(_LAYER)}
    if not layers:
        raise FileFormatError("expected channels such as T.550,000000nm, got none")
    quantity = provenance.get("quantity", "R")
    ascending = sorted(layers)
    arrays: dict[str, NDArray[Any]] = {
        quantity: np.stack([layers[nm] for nm in ascending], axis=-1),
        "wavelength_nm": np.array(ascending),
    }
    if set("RGB") <= channels.keys():
        arrays[f"{quantity}_rgb"] = np.stack([channels[name] for name in "RGB"], axis=-1)
    return Contents(arrays, provenance, found)


def _wavelength_nm(channel: str) -> float:
    number = channel.removeprefix(_LAYER).removesuffix("nm")
    try:
        return float(number.replace(",", "."))
    except ValueError:
        raise FileFormatError(f"expected a channel such as T.550,000000nm, got {channel}") from None
