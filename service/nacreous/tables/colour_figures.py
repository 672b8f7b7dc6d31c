"""What the certificates of every quantity say of its colours."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.optics.colour import ColourSystem, lab
from nacreous.optics.delta_e import delta_e_2000
from nacreous.tables.colour import Colouring

__all__ = ["NO_COLOUR_FIGURES", "colour_figures", "colours_apart"]

FloatArray = NDArray[np.float64]

GAMUT_ROUNDING = 1e-5
"""What a component may be outside of its range by and still count as rounded."""

NO_COLOUR_FIGURES: dict[str, Any] = {
    "delta_e_max": None,
    "delta_e_p99": None,
    "out_of_gamut": None,
    "quadrature_error": None,
}
"""The figures of a table whose wavelengths span no colour."""


def colours_apart(interpolated: FloatArray, exact: FloatArray, system: ColourSystem) -> FloatArray:
    """CIEDE2000 of two arrays of linear colours, (…, 3): (…)."""
    first, second = (lab(system.to_xyz(colour), system.white) for colour in (interpolated, exact))
    return delta_e_2000(first, second)


def colour_figures(
    apart: FloatArray, texels: FloatArray, colouring: Colouring, brightest: float = 1.0
) -> dict[str, Any]:
    """Return the figures of differences, of the texels about them, (…, 3), and of the quadrature.

    A colour is outside of the gamut where a component is below 0, or above `brightest`.
    """
    outside = (texels < -GAMUT_ROUNDING) | (texels > brightest + GAMUT_ROUNDING)
    return {
        "delta_e_max": float(apart.max()),
        "delta_e_p99": float(np.quantile(apart, 0.99)),
        "out_of_gamut": float(outside.any(axis=-1).mean()),
        "quadrature_error": colouring.error,
    }
