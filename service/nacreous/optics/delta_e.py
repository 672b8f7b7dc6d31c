"""How different two colours look: CIEDE2000."""

import numpy as np
from numpy.typing import NDArray

__all__ = ["delta_e_2000"]

FloatArray = NDArray[np.float64]


def delta_e_2000(first: FloatArray, second: FloatArray) -> FloatArray:
    """CIEDE2000 of two L*a*b* colours, shape (..., 3) both; about 1 is just noticeable.

    Source: Sharma, Wu & Dalal 2005, eq 2 to 22, with all weights 1. (colour-science has the same formula, but
    importing it takes longer than a whole table.)
    """
    chroma_mean = (np.hypot(first[..., 1], first[..., 2]) + np.hypot(second[..., 1], second[..., 2])) / 2
    stretch = 1.5 - 0.5 * _seventh(chroma_mean)
    L1, C1, h1 = _lightness_chroma_hue(first, stretch)
    L2, C2, h2 = _lightness_chroma_hue(second, stretch)
    L, C, h = (L1 + L2) / 2, (C1 + C2) / 2, _mean_hue(h1, h2, C1 * C2)
    dH = 2 * np.sqrt(C1 * C2) * np.sin(_hue_difference(h1, h2, C1 * C2) / 2)
    t = 1 - 0.17 * np.cos(h - _deg(30)) + 0.24 * np.cos(2 * h)
    t += 0.32 * np.cos(3 * h + _deg(6)) - 0.20 * np.cos(4 * h - _deg(63))
    lightness = (L2 - L1) / (1 + 0.015 * (L - 50) ** 2 / np.sqrt(20 + (L - 50) ** 2))
    chroma = (C2 - C1) / (1 + 0.045 * C)
    hue = dH / (1 + 0.015 * C * t)
    rotation = -np.sin(2 * _deg(30) * np.exp(-(((np.degrees(h) - 275) / 25) ** 2))) * 2 * _seventh(C)
    squared: FloatArray = lightness**2 + chroma**2 + hue**2 + rotation * chroma * hue
    return np.sqrt(np.maximum(squared, 0))


def _deg(degrees: float) -> float:
    return float(np.radians(degrees))


def _seventh(chroma: FloatArray) -> FloatArray:
    """sqrt(C^7 / (C^7 + 25^7)): 0 for greys, towards 1 for vivid colours."""
    power = (chroma / 25) ** 7
    return np.sqrt(power / (power + 1))


def _lightness_chroma_hue(lab: FloatArray, stretch: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    a = lab[..., 1] * stretch
    return lab[..., 0], np.hypot(a, lab[..., 2]), np.arctan2(lab[..., 2], a) % (2 * np.pi)


def _hue_difference(h1: FloatArray, h2: FloatArray, chroma_product: FloatArray) -> FloatArray:
    difference = h2 - h1
    difference = difference - 2 * np.pi * (difference > np.pi) + 2 * np.pi * (difference < -np.pi)
    return np.where(chroma_product == 0, 0, difference)


def _mean_hue(h1: FloatArray, h2: FloatArray, chroma_product: FloatArray) -> FloatArray:
    total = h1 + h2
    far = np.abs(h1 - h2) > np.pi
    mean = total / 2 + np.where(far, np.where(total < 2 * np.pi, np.pi, -np.pi), 0)
    return np.where(chroma_product == 0, total, mean)
