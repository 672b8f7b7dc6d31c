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
    lightness1, chroma1, hue1 = _lightness_chroma_hue(first, stretch)
    lightness2, chroma2, hue2 = _lightness_chroma_hue(second, stretch)
    product = chroma1 * chroma2
    lightness, chroma, hue = (
        (lightness1 + lightness2) / 2,
        (chroma1 + chroma2) / 2,
        _mean_hue(hue1, hue2, product),
    )
    t = 1 - 0.17 * np.cos(hue - _deg(30)) + 0.24 * np.cos(2 * hue)
    t += 0.32 * np.cos(3 * hue + _deg(6)) - 0.20 * np.cos(4 * hue - _deg(63))
    off_middle = (lightness - 50) ** 2
    d_lightness = (lightness2 - lightness1) / (1 + 0.015 * off_middle / np.sqrt(20 + off_middle))
    d_chroma = (chroma2 - chroma1) / (1 + 0.045 * chroma)
    d_hue = 2 * np.sqrt(product) * np.sin(_hue_difference(hue1, hue2, product) / 2) / (1 + 0.015 * chroma * t)
    squared = d_lightness**2 + d_chroma**2 + d_hue**2 + _rotation(chroma, hue) * d_chroma * d_hue
    return np.sqrt(np.maximum(squared, 0))


def _rotation(chroma: FloatArray, hue: FloatArray) -> FloatArray:
    """Interaction of chroma and hue in the blues (eq 19 to 21)."""
    angle = _deg(30) * np.exp(-(((np.degrees(hue) - 275) / 25) ** 2))
    return -np.sin(2 * angle) * 2 * _seventh(chroma)


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
