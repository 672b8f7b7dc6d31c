"""Colours for the eye: linear table colours as the 8-bit sRGB that every screen and viewer expects."""

import numpy as np
from numpy.typing import NDArray

from nacreous.tables.spec import ColourSpec

__all__ = ["encoded", "out_of_gamut", "rec709"]

_NAMES = {"ACEScg": "ACEScg", "Rec.2020": "ITU-R BT.2020"}
"""Spaces other than Rec.709 and XYZ, as colour-science calls them."""


def encoded(linear: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Return linear Rec.709 colours as sRGB bytes, clipped to the gamut (IEC 61966-2-1:1999)."""
    value = np.clip(linear, 0, 1)
    curve = np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)
    return np.rint(255 * curve).astype(np.uint8)


def out_of_gamut(linear: NDArray[np.floating]) -> float:
    """Return the share of colours, shape (…, 3), that clipping changes by more than a step of 8 bits."""
    step = 1 / 255 / 12.92  # the smallest step of 8-bit sRGB, at black
    outside = (linear < -step) | (linear > 1 + step)
    return float(outside.any(axis=-1).mean())


def rec709(colours: NDArray[np.floating], colour: ColourSpec) -> NDArray[np.floating]:
    """Return table colours, shape (…, 3), in linear Rec.709; those of a table in Rec.709 are as they were."""
    return colours if colour.space == "Rec.709" else colours @ _to_rec709(colour).T


def _to_rec709(colour: ColourSpec) -> NDArray[np.float64]:
    """Return the matrix from the table's space, Bradford-adapted to the white of Rec.709."""
    import colour as science

    target = science.RGB_COLOURSPACES["ITU-R BT.709"]
    if colour.space == "XYZ":
        white = science.CCS_ILLUMINANTS[colour.observer][colour.illuminant]
        adapted = science.adaptation.matrix_chromatic_adaptation_VonKries(
            science.xy_to_XYZ(white), science.xy_to_XYZ(target.whitepoint), "Bradford"
        )
        return np.asarray(target.matrix_XYZ_to_RGB @ adapted)
    source = science.RGB_COLOURSPACES[_NAMES[colour.space]]
    return np.asarray(science.matrix_RGB_to_RGB(source, target, "Bradford"))
