"""Colours for the eye: linear table colours as the 8-bit sRGB that every screen and viewer expects."""

import numpy as np
from numpy.typing import NDArray

__all__ = ["encoded", "out_of_gamut"]


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
