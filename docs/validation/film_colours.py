"""Colours and spectra of films, as Nacreous tabulates them."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nacreous.tables.presets import preset
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part
from nacreous.tables.tabulate import tabulate_table

FloatArray = NDArray[np.float64]


def colours_over_thickness(name: str, thickness_nm: FloatArray) -> FloatArray:
    """Linear Rec.709 under D65 of a preset's one layer at normal incidence: (thicknesses, 3)."""
    scale = thickness_nm / preset(name).stack.layers[0].thickness_nm
    first, last, count = float(scale[0]), float(scale[-1]), scale.size
    axis = f"table.thickness_scale={{start={first!r}, stop={last!r}, count={count}}}"
    table = tabulate_table(preset(name, [axis, "table.cos_theta=[0.5, 1.0]"]), [Part.COLOUR])
    return np.asarray(table.values("R_rgb")[:, -1], np.float64)


def colours_over_angle(stack: Mapping[str, Any], angles_deg: ArrayLike) -> FloatArray:
    """Linear Rec.709 under D65 of a stack at ascending angles of incidence: (angles, 3)."""
    cosines = np.cos(np.radians(angles_deg))
    document = {"stack": stack, "table": {"cos_theta": cosines[::-1].tolist()}}
    table = tabulate_table(Spec.from_document(document), [Part.COLOUR])
    return np.asarray(table.values("R_rgb")[0, ::-1], np.float64)


def spectra(name: str, scales: list[float], wavelength_nm: FloatArray) -> FloatArray:
    """Return R of unpolarised light at normal incidence of a preset: (scales, wavelengths)."""
    first, last, count = float(wavelength_nm[0]), float(wavelength_nm[-1]), wavelength_nm.size
    overrides = [
        f"table.wavelength_nm={{start={first!r}, stop={last!r}, count={count}}}",
        f"table.thickness_scale={scales}",
        "table.cos_theta=[0.5, 1.0]",
    ]
    table = tabulate_table(preset(name, overrides), [Part.SPECTRUM])
    return np.asarray((table.values("R_s")[:, -1] + table.values("R_p")[:, -1]) / 2, np.float64)
