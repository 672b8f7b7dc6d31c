"""Linear colour of a reflectance by way of colour-science: the reference for our own colour integrals.

Summation at 1 nm over the observer's whole range (CIE 15, "Calculation of tristimulus values"), normalised so
that R = 1 is white, Bradford-adapted from the illuminant to the colour space's white. `colour` is imported
where it is used, because that takes a second or two.
"""

import numpy as np
from numpy.typing import NDArray

from reference import film

WAVELENGTH_NM = np.arange(360.0, 831.0)
"""Range and step of the CIE 1931 colour-matching functions."""


def linear_rgb(
    reflectance: NDArray[np.float64], *, illuminant: str = "D65", space: str = "ITU-R BT.709"
) -> NDArray[np.float64]:
    """Linear RGB of reflectances sampled at `WAVELENGTH_NM`.

    Parameters
    ----------
    reflectance
        (..., 471).
    illuminant, space
        Names of colour-science.

    Returns
    -------
    (..., 3); negative or above 1 where the colour is outside of the gamut.
    """
    import colour

    rgb_space = colour.RGB_COLOURSPACES[space]
    source_white = _tristimulus(np.ones(WAVELENGTH_NM.shape), illuminant)
    target_white = colour.xy_to_XYZ(rgb_space.whitepoint)
    adaptation = colour.adaptation.matrix_chromatic_adaptation_VonKries(
        source_white, target_white, "Bradford"
    )
    matrix = rgb_space.matrix_XYZ_to_RGB @ adaptation  # (3, 3)
    rgb: NDArray[np.float64] = _tristimulus(reflectance, illuminant) @ matrix.T
    return rgb


def film_colour(
    index: NDArray[np.complex128], thickness_nm: NDArray[np.float64], cos_theta: float
) -> NDArray[np.float64]:
    """Linear Rec.709 of a film under D65 in unpolarised light, (3,)."""
    at = film(index, thickness_nm, WAVELENGTH_NM, cos_theta)
    return linear_rgb((at.R_s[0] + at.R_p[0]) / 2)


def _tristimulus(reflectance: NDArray[np.float64], illuminant: str) -> NDArray[np.float64]:
    """XYZ, (..., 3); Y = 1 for R = 1."""
    import colour

    shape = colour.SpectralShape(360, 830, 1)
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    source = colour.SDS_ILLUMINANTS[illuminant].copy().align(shape)
    xyz = colour.msds_to_XYZ(reflectance, observer, source, method="Integration", shape=shape)
    return np.asarray(xyz, np.float64) / 100
