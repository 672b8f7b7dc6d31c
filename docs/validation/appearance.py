"""How a linear colour looks: CIELAB lightness, chroma and hue, and the pixel that shows it."""

import numpy as np
from numpy.typing import NDArray

from nacreous.optics.colour import ColourSystem, colour_system, lab
from nacreous.optics.delta_e import delta_e_2000

FloatArray = NDArray[np.float64]

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""Of linear Rec.709, ITU-R BT.709-6."""


def screen() -> ColourSystem:
    """Return linear Rec.709 under D65."""
    return colour_system("D65", "CIE 1931 2 Degree Standard Observer", "Rec.709")


def lightness_chroma_hue(rgb: FloatArray) -> FloatArray:
    """CIELAB L*, C* and hue in degrees of linear Rec.709, (..., 3), relative to D65."""
    system = screen()
    L, a, b = np.moveaxis(lab(system.to_xyz(rgb), system.white), -1, 0)  # noqa: N806 - the symbol
    return np.stack([L, np.hypot(a, b), np.degrees(np.arctan2(b, a)) % 360], axis=-1)


def colour_difference(first: FloatArray, second: FloatArray) -> FloatArray:
    """CIEDE2000 of linear Rec.709 colours, (..., 3) both: (...)."""
    system = screen()
    return delta_e_2000(*(lab(system.to_xyz(rgb), system.white) for rgb in (first, second)))


def shown(rgb: FloatArray, white: float) -> FloatArray:
    """Return sRGB pixels of linear colours, 0 to 1, in a picture where a reflectance of `white` is white.

    Components below 0, which no screen has, are 0.
    """
    return encoded(rgb / white)


def encoded(linear: FloatArray) -> FloatArray:
    """Encode linear light as sRGB (IEC 61966-2-1)."""
    light = np.clip(linear, 0, 1)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
