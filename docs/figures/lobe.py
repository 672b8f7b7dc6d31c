"""How wide the lobe of a surface is, in the planes of its x and y: as Mitsuba reads a file, and exactly."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mitsuba_surface import bsdf_values
from nacreous.optics.surface import Surface
from reference_surface import Coating, f_r
from reference_surface import Surface as ReferenceSurface

FloatArray = NDArray[np.float64]

WAVELENGTH_NM = np.array([450.0, 510.0, 570.0, 630.0])
_OUT_DEG = np.linspace(0.0, 85.0, 341)
_ALMOST_NORMAL = np.array([1e-3, 1e-3, 1.0]) / np.linalg.norm([1e-3, 1e-3, 1.0])
"""The incoming light: azimuths are parted at the normal itself."""


@dataclass(frozen=True)
class Lobe:
    """Full widths at half the height of f, the mean of four wavelengths, for light along the normal."""

    x_deg: float
    y_deg: float


def shown_width(width_deg: float) -> str:
    """Return a width in words of a table; a lobe that does not fall to half above the horizon has none."""
    return f"{width_deg:.1f}°" if width_deg < 2 * _OUT_DEG[-1] else f"over {width_deg:.0f}°"


def lobe_of_file(file: Path) -> Lobe:
    """Measure a ``.bsdf``."""
    import mitsuba as mi

    bsdf = mi.load_dict({"type": "measured", "filename": str(file)})
    return _measured(lambda i, o: bsdf_values(bsdf, i, o, WAVELENGTH_NM))


def lobe_of_film(surface: Surface, index: FloatArray, thickness_nm: float) -> Lobe:
    """Measure equation 12 with exact films: `index` is (3,), that of the outside, the film, the substrate."""
    alpha_x, alpha_y = surface.alphas or (1.0, 1.0)
    exact = ReferenceSurface(surface.distribution, alpha_x, alpha_y, masking=surface.masking)
    coating = Coating(
        np.repeat(index[:, None], len(WAVELENGTH_NM), 1), np.array([thickness_nm]), WAVELENGTH_NM
    )
    return _measured(lambda i, o: f_r(exact, coating, i, o))


def _measured(f: Callable[[FloatArray, FloatArray], FloatArray]) -> Lobe:
    theta = np.radians(_OUT_DEG)
    incoming = np.repeat(_ALMOST_NORMAL[None], len(theta), axis=0)
    zero = np.zeros_like(theta)
    fans = (
        np.stack([np.sin(theta), zero, np.cos(theta)], axis=-1),
        np.stack([zero, np.sin(theta), np.cos(theta)], axis=-1),
    )
    return Lobe(*(2 * _half_width_deg(f(incoming, fan).mean(axis=1)) for fan in fans))


def _half_width_deg(values: FloatArray) -> float:
    """Return the first angle at which values fall below half of the first; the last where they do not."""
    half = values[0] / 2
    if values.min() >= half:
        return float(_OUT_DEG[-1])
    at = int(np.argmax(values < half))
    share = (values[at - 1] - half) / (values[at - 1] - values[at])
    return float(_OUT_DEG[at - 1] + share * (_OUT_DEG[at] - _OUT_DEG[at - 1]))
