"""Colours for the eye: linear table colours as the 8-bit sRGB that every screen and viewer expects."""

import numpy as np
from numpy.typing import NDArray

from nacreous.optics.colour import colour_system
from nacreous.tables.spec import ColourSpec

__all__ = ["encoded", "out_of_gamut", "rec709"]


def encoded(linear: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Return linear Rec.709 colours as sRGB bytes, clipped to the gamut (IEC 61966-2-1:1999)."""
    value = np.clip(linear, 0, 1)
    curve = np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)
    return np.asarray(np.rint(255 * curve), np.uint8)


def out_of_gamut(linear: NDArray[np.floating]) -> float:
    """Return the share of colours, shape (…, 3), that clipping changes by more than a step of 8 bits."""
    step = 1 / 255 / 12.92  # the smallest step of 8-bit sRGB, at black
    outside = (linear < -step) | (linear > 1 + step)
    return float(outside.any(axis=-1).mean())


def rec709(colours: NDArray[np.floating], colour: ColourSpec) -> NDArray[np.floating]:
    """Return table colours, shape (…, 3), in linear Rec.709; those of a table in Rec.709 are as they were."""
    if colour.space == "Rec.709":
        return colours
    table, screen = (
        colour_system(colour.illuminant, colour.observer, space) for space in (colour.space, "Rec.709")
    )
    to_screen = screen.from_xyz @ np.linalg.inv(table.from_xyz)  # both start at the illuminant's XYZ
    return np.asarray(colours @ to_screen.T)
