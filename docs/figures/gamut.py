"""Colours that a screen does not have, brought into its gamut with their dominant wavelength kept."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""Y of the primaries of Rec.709."""


def whitened(linear: FloatArray) -> FloatArray:
    """Mix linear colours (…, 3) with the grey of their own luminance until no channel is below 0.

    Clipping a channel at 0 instead would turn the hue: saturated violets to blue, greenish blues to cyan.
    """
    grey = np.maximum(linear @ _LUMINANCE, 0)[..., None]
    lowest = linear.min(axis=-1, keepdims=True)
    share = np.where(lowest < 0, grey / np.maximum(grey - lowest, 1e-12), 1.0)
    return np.asarray(grey + share * (linear - grey))
