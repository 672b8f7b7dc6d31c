"""``spectral-exr``: the spectrum of every texel in the layout of Fichet, Pacanowski and Wilkie.

A. Fichet, R. Pacanowski, A. Wilkie, "An OpenEXR Layout for Spectral Images", JCGT 10(3), 2021. Unpolarised
reflectance (R_s + R_p) / 2, or the albedo E_r, is in one channel a wavelength, ``T.550,000000nm``, with the
decimal comma that the layout asks for. R, G and B are the preview; a table in XYZ, or beyond the visible, has
none. Where the substrate transmits, and always beyond the visible, the transmittance, or E_t, is in a second
file, ``film.transmission.spectral.exr``. Axes are those of the lookup texture. The layout has no layer for
a BSDF, whose values are per steradian.

It is for spectral renderers and for analysis. **Blender 4.5 and 5.2 crash on a part of more than 24
channels**: give them the file of the `exr` format. An EXR sorts its channels by name, so wavelengths of
1,000 nm and more come before the shorter ones: go by the names, not by the order.
"""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import FileFormatError
from nacreous.formats.atlas import LAYOUTS, table_atlas
from nacreous.formats.atomic import replacing
from nacreous.formats.contents import Contents
from nacreous.formats.lookup import coloured_names, colours, lookup_attributes, lookup_files, required
from nacreous.formats.openexr import read_part, write_part
from nacreous.tables.table import Table

__all__ = ["QUANTITIES", "SUFFIX", "read", "write"]

SUFFIX = ".spectral.exr"

_LAYER = "T."
"""Begins the name of a reflective or transmissive layer; emissive ones would be ``S0.``."""
_POLARISED: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {"R": ("R_s", "R_p"), "T": ("T_s", "T_p"), "E_r": ("E_r",), "E_t": ("E_t",)}
)
"""The spectra whose mean is stored, of every part that the layout has a layer for."""
QUANTITIES = frozenset(name for name, layout in LAYOUTS.items() if _POLARISED.keys() >= set(layout.names))
"""What a spec can ask for in this format."""


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write the unpolarised spectra of `table` and return the files; raises `FileFormatError`."""
    files, obsolete = lookup_files(table, path, SUFFIX, _names(table), read)
    with replacing(*files.values(), obsolete=obsolete) as temporaries:
        for name, temporary in zip(files, temporaries, strict=True):
            layout: dict[str, str | float] = {"spectralLayoutVersion": "1.0", "EV": 0.0}
            attributes = {**lookup_attributes(table, name), **layout}
            write_part(temporary, _spectrum(table, name) | _preview(table, name), attributes)
    return tuple(files.values())


def _names(table: Table) -> tuple[str, ...]:
    """Return the parts to write: what transmits nothing that is visible may transmit the infrared."""
    quantity = table.spec.table.quantity
    if quantity not in QUANTITIES:
        raise FileFormatError(f"expected shares of the light, got {quantity}; npz, netcdf and exr hold it")
    return coloured_names(table) if _has_colours(table) else LAYOUTS[quantity].names


def _has_colours(table: Table) -> bool:
    return f"{LAYOUTS[table.spec.table.quantity].names[0]}_rgb" in table.variables


def _spectrum(table: Table, name: str) -> dict[str, NDArray[np.float32]]:
    polarised = _POLARISED[name]
    mean = np.mean([required(table, each) for each in polarised], axis=0)
    texels = table_atlas(table).picture(mean, table.variables[polarised[0]].dims)  # (H, W, L)
    return {_channel(nm): texels[..., at] for at, nm in enumerate(table.values("wavelength_nm"))}


def _channel(wavelength_nm: float) -> str:
    number = f"{wavelength_nm:.6f}".replace(".", ",")
    return f"{_LAYER}{number}nm"


def _preview(table: Table, name: str) -> dict[str, NDArray[np.float32]]:
    if table.spec.colour.space == "XYZ" or not _has_colours(table):
        return {}
    texels = colours(table, name)  # (H, W, 3)
    return {key: texels[..., at] for at, key in enumerate("RGB")}


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
