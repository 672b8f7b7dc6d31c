"""``mueller``: Mueller matrices of an isotropic film for Mitsuba 3's `measured_polarized`.

``film.pbsdf`` is a tensor file (`nacreous.formats.tensor_file`) in the layout of S.-H. Baek et al. 2020,
which Mitsuba reads in its ``*_spectral_polarized`` variants.

=====================  ======================  ===============================================================
field                  type and shape          meaning
=====================  ======================  ===============================================================
``description``        text                    the spec's name
``phi_d``              f32 (1, P)              azimuth of the light about the half vector, -pi to pi
``theta_d``            f32 (1, D)              angle of the light to the half vector, 0 to pi / 2
``theta_h``            f32 (1, H)              angle of the half vector to the normal, 0 to pi / 2
``wvls``               u16 (5)                 wavelengths in whole nm
``M``                  f32 (P, D, H, 5, 4, 4)  Mueller matrix times f in 1 / sr, without the cosine
=====================  ======================  ===============================================================

The first axis of either Stokes frame is perpendicular to the plane of reflection. Wavelengths are the spec's
where it lists just five whole ones, and otherwise five spread over its range; Mitsuba is linear between them,
which the certificate's lobe errors include and its grid errors do not. All nodes are finite, those below the
horizon, too: Mitsuba looks at the cosines by itself, and a NaN would blacken the cells around it.
`nacreous.tables.measured.mueller` derives the numbers.

Nodes are dense where f bends, in all three angles. At every node M00 is f within 1e-3, which the
certificate's ``node_error_max`` measures. Files are of 40, 79 or 148 MB, the smallest in which linear
interpolation keeps nine tenths of the lobe, half of all other directions and the light as a whole within
1e-3, too. Where the largest does not, its certificate says so, and `nacreous tabulate` warns where M00 is
off by more than 1e-3 at half of the lobe, at a node, or of the light as a whole: fringes of films of more
than 5 micrometres are finer than the grid.

Refused are several roughnesses, transmitted light, anisotropic surfaces, layers that are averaged in
intensity, a phong lobe, multiple scattering, and roughnesses below 0.02.
"""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.formats.contents import Contents
from nacreous.formats.lookup import required
from nacreous.formats.rgl import NARROW
from nacreous.formats.tensor_file import read_tensors, text, write_tensors
from nacreous.tables.measured.mueller import check_polarised, mueller_wavelengths_nm
from nacreous.tables.measured.surface import (
    check_isotropic,
    check_least_alpha,
    check_one_roughness,
    check_opaque,
)
from nacreous.tables.sampling import Sampling
from nacreous.tables.spec import Spec
from nacreous.tables.table import Table

__all__ = ["SUFFIX", "check", "read", "write"]

SUFFIX = ".pbsdf"
LEAST_ALPHA = 0.02


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write `table` and return the file; raises `FileFormatError`."""
    angles = {name: table.values(name).astype(np.float32)[None] for name in ("phi_d", "theta_d", "theta_h")}
    fields: dict[str, NDArray[Any]] = {
        "description": text("a film by Nacreous"),
        **angles,
        "wvls": table.values("wavelength_nm").astype(np.uint16),
        "M": required(table, "M"),
    }
    write_tensors(path, fields, table.provenance)
    return (path,)


def read(path: Path) -> Contents:
    """Return all fields and the provenance; raises `FileFormatError`."""
    return read_tensors(path, Sampling.MUELLER)


def check(spec: Spec) -> None:
    """Refuse a spec whose meaning the file would lose; raises `SpecError` with what holds it."""
    check_one_roughness(spec, "mueller")
    check_isotropic(spec, "mueller", "rgl")
    check_opaque(spec, "mueller", "mbsdf")
    check_polarised(spec)
    check_least_alpha(spec, "mueller", LEAST_ALPHA, NARROW)
    mueller_wavelengths_nm(spec)
