"""``rgl`` and ``rgl-rgb``: measured materials for Mitsuba 3, pbrt-v4 and Falcor, as they are.

``film.bsdf`` is what Mitsuba's ``measured`` plugin loads in spectral variants, and pbrt-v4's ``measured``
material; ``film.rgb.bsdf`` is for Mitsuba's RGB variants and for Falcor. Both are tensor files
(`nacreous.formats.tensor_file`) in the layout of the RGL material database (J. Dupuy and W. Jakob 2018).

==================  =====================  =================================================================
field               shape                  meaning
==================  =====================  =================================================================
``description``     text                   the spec's name
``jacobian``        1                      1: f has been divided by ndf / (4 sigma)
``phi_i``           Q                      azimuth of the incoming light in radians; 0 alone if isotropic
``theta_i``         I                      its angle to the normal in radians, 0 to 89 degrees
``ndf, sigma``      G, K                   distribution of facets, and their projected area
``vndf``            Q, I, H, W             density over facets, which the square is warped by
``luminance``       Q, I, N, N             what a renderer samples first
``spectra``         Q, I, L, N, N          ``rgl``: f cos_o 4 sigma / ndf
``wavelengths``     L                      ``rgl``: in nm; a reader interpolates, and holds the outermost
``rgb``             Q, I, 3, N, N          ``rgl-rgb``: the same in linear colours
==================  =====================  =================================================================

Facets and directions lie on the square by theta = u^2 pi / 2 along its last axis and phi = (2 u - 1) pi along
the one before. `nacreous.tables.measured.rgl` derives the tables. They hold reflected light alone, on one
side, of one roughness: what a spec transmits is refused unless it gives it up (`table.transmission`), and so
are roughnesses below 0.02, whose lobes are narrower than the grid. Readers take the colours for their own
space, which is Rec.709 where nobody has changed it. Files of 81 wavelengths are of 5 to 20 MB, up to 40 of an
anisotropic surface; more wavelengths take more. The certificate states the error that a reader has, for light
from up to 75 degrees: beyond, S falls off faster than any grid follows.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.formats.contents import Contents
from nacreous.formats.lookup import colour_facts, required
from nacreous.formats.tensor_file import read_tensors, text, write_tensors
from nacreous.tables.measured.surface import check_least_alpha, check_one_roughness, check_opaque, check_rgb
from nacreous.tables.sampling import Sampling
from nacreous.tables.spec import Spec
from nacreous.tables.table import Table

__all__ = [
    "COLOUR_SUFFIX",
    "SUFFIX",
    "check",
    "check_colours",
    "read",
    "read_colours",
    "write",
    "write_colours",
]

SUFFIX, COLOUR_SUFFIX = ".bsdf", ".rgb.bsdf"
LEAST_ALPHA = 0.02
NARROW = 'take quantity = "fresnel" as exr, and the renderer\'s own microfacets'
"""What to do about a lobe that no grid of directions holds."""
_FACETS = ("ndf", "sigma", "vndf", "luminance")


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write the spectra of `table` and return the file; raises `FileFormatError`."""
    spectra = {
        "spectra": required(table, "spectra"),
        "wavelengths": _single(table, "wavelength_nm"),
    }
    return _write(table, path, spectra, table.provenance)


def write_colours(table: Table, path: Path) -> tuple[Path, ...]:
    """Write the colours of `table` and return the file; raises `FileFormatError`."""
    facts = {**table.provenance, **colour_facts(table.spec.colour)}
    return _write(table, path, {"rgb": required(table, "rgb")}, facts)


def _write(
    table: Table, path: Path, values: Mapping[str, NDArray[Any]], provenance: Mapping[str, str]
) -> tuple[Path, ...]:
    fields: dict[str, NDArray[Any]] = {
        "description": text("a film by Nacreous"),
        "jacobian": np.ones(1, np.uint8),
        **{name: _single(table, name) for name in ("phi_i", "theta_i")},
        **{name: required(table, name) for name in _FACETS},
        **values,
    }
    write_tensors(path, fields, provenance)
    return (path,)


def _single(table: Table, axis: str) -> NDArray[np.float32]:
    return table.values(axis).astype(np.float32)


def read(path: Path) -> Contents:
    """Return all fields and the provenance; raises `FileFormatError`."""
    return read_tensors(path, Sampling.RGL_SPECTRA)


def read_colours(path: Path) -> Contents:
    """Return all fields and the provenance; raises `FileFormatError`."""
    return read_tensors(path, Sampling.RGL_COLOURS)


def check(spec: Spec) -> None:
    """Refuse a spec whose meaning the file would lose; raises `SpecError` with what holds it."""
    _check(spec, "rgl")


def check_colours(spec: Spec) -> None:
    """Refuse a spec whose meaning the file would lose, or whose colours are no red, green and blue."""
    _check(spec, "rgl-rgb")
    check_rgb(spec, "rgl-rgb")


def _check(spec: Spec, name: str) -> None:
    check_one_roughness(spec, name)
    check_opaque(spec, name, "mbsdf")
    check_least_alpha(spec, name, LEAST_ALPHA, NARROW)
