"""The one thin film that glTF and the engines of the web can show: KHR_materials_iridescence.

The formula is that of the Khronos extension's specification, which its sample viewer, three.js and Babylon.js
ship: L. Belcour and P. Barla, "A Practical Extension to Microfacet Theory for the Modeling of Varying
Iridescence", ACM Transactions on Graphics 36(4), 2017, for one dielectric film in air, made quick:

* a film without dispersion and without absorption,
* a base that is known by its colour F0 at normal incidence in air alone, as if its index were real: what a
  metal's k does to the phase is lost,
* Fresnel's coefficients by Schlick's approximation, the same for s and p,
* the sum over the echoes cut after the second, and each echo's colour integrated with Gaussians in the place
  of the colour-matching functions.

It is written here to say how far it is from a film, and to find the parameters that bring it closest. Engines
differ a little: three.js has a Gaussian in the place of Schlick's fifth power, as Epic's engine had in 2013.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Iridescence", "iridescent_reflectance"]

FloatArray = NDArray[np.float64]

_GAUSSIAN_VALUE = np.array([5.4856e-13, 4.4201e-13, 5.2481e-13, 9.7470e-14])
_GAUSSIAN_POSITION = np.array([1.6810e06, 1.7953e06, 2.2084e06, 2.2399e06])  # rad / m, as wave numbers
_GAUSSIAN_VARIANCE = np.array([4.3278e09, 9.3046e09, 6.6121e09, 4.5282e09])
_NORMALISATION = 1.0685e-7
"""Gaussians for X, Y, Z and the blue lobe of X, and their norm: Belcour & Barla 2017, supplemental code."""

_REC709_FROM_XYZ = np.array(
    [
        [3.2404542, -1.5371385, -0.4985314],
        [-0.9692660, 1.8760108, 0.0415560],
        [0.0556434, -0.2040259, 1.0572252],
    ]
)
"""With the digits that the extension has, so that we compute what it shows."""

_ECHOES = 2
_MOST_F0 = 0.9999
"""F0 at which the base's index, (1 + sqrt F0) / (1 - sqrt F0), ends."""
_LEAST_ECHO = 1e-5
_WHOLE_FILM_NM = 0.03
"""Thickness over which the film's index grows from that of the air to its own."""


@dataclass(frozen=True, eq=False)
class Iridescence:
    """The parameters of the formula; a leading shape (...) is that of a batch, () for one.

    Parameters
    ----------
    ior : float array, shape (...)
        Refractive index of the film, ``iridescenceIor``.
    thickness_nm : float array, shape (...)
        ``iridescenceThicknessMaximum``.
    base_f0 : float array, shape (..., 3)
        Linear Rec.709 of what lies under the film, at normal incidence in air: the base colour of a metal.
    factor : float array, shape (...)
        0 for the bare base to 1 for the film, ``iridescenceFactor``.
    """

    ior: FloatArray
    thickness_nm: FloatArray
    base_f0: FloatArray
    factor: FloatArray


def iridescent_reflectance(film: Iridescence, cos_theta: FloatArray) -> FloatArray:
    """Linear Rec.709 reflectance at cosines of incidence in air, shape (A,): (..., A, 3).

    Negative components are 0, as the extension has them.
    """
    weight = film.factor[..., None, None]
    bare = _schlick(film.base_f0[..., None, :], cos_theta[:, None])
    mixed: FloatArray = (1 - weight) * bare + weight * _film_reflectance(film, cos_theta)
    return mixed


def _film_reflectance(film: Iridescence, cos_theta: FloatArray) -> FloatArray:
    grown = _smooth_step(film.thickness_nm / _WHOLE_FILM_NM)
    ior = (1 + (film.ior - 1) * grown)[..., None]  # (..., 1)
    cos_inside = np.sqrt(1 - (1 - cos_theta**2) / ior**2)  # (..., A): Snell's law
    outer = _schlick(_normal_reflectance(ior, 1.0), cos_theta)[..., None]  # (..., A, 1)
    base_ior = _ior_of(film.base_f0)[..., None, :]  # (..., 1, 3)
    inner = _schlick(_normal_reflectance(base_ior, ior[..., None]), cos_inside[..., None])  # (..., A, 3)
    phase = np.pi + np.pi * (base_ior < ior[..., None])  # of both reflections inside the film
    path_nm = 2 * ior * film.thickness_nm[..., None] * cos_inside
    return _echoes(outer, inner, path_nm, np.broadcast_to(phase, inner.shape))


def _echoes(outer: FloatArray, inner: FloatArray, path_nm: FloatArray, phase: FloatArray) -> FloatArray:
    """Sum the light that the film returns at once, and after echoes (Belcour & Barla 2017, equation 10)."""
    through = 1 - outer
    both = np.clip(outer * inner, _LEAST_ECHO, _MOST_F0)
    bounced = through**2 * inner / (1 - both)
    total, strength = outer + bounced, bounced - through
    for m in range(1, _ECHOES + 1):
        strength = strength * np.sqrt(both)
        total = total + 2 * strength * _echo_colour(m * path_nm, m * phase)
    return np.maximum(total, 0)


def _echo_colour(path_nm: FloatArray, phase: FloatArray) -> FloatArray:
    """Linear Rec.709 of a cosine of the wave number, from path differences (..., A), phases (..., A, 3)."""
    turn = 2 * np.pi * 1e-9 * path_nm[..., None]
    shift = np.concatenate([phase, phase[..., :1]], axis=-1)
    size = _GAUSSIAN_VALUE * np.sqrt(2 * np.pi * _GAUSSIAN_VARIANCE) / _NORMALISATION
    lobes = size * np.cos(_GAUSSIAN_POSITION * turn + shift) * np.exp(-_GAUSSIAN_VARIANCE * turn**2)
    xyz = lobes[..., :3] + lobes[..., 3:] * np.array([1.0, 0.0, 0.0])
    colour: FloatArray = xyz @ _REC709_FROM_XYZ.T
    return colour


def _schlick(f0: FloatArray, cos_theta: FloatArray) -> FloatArray:
    """Schlick 1994, equation 15."""
    return f0 + (1 - f0) * (1 - cos_theta) ** 5


def _normal_reflectance(ior: FloatArray, outside: FloatArray | float) -> FloatArray:
    return ((ior - outside) / (ior + outside)) ** 2


def _ior_of(f0: FloatArray) -> FloatArray:
    """Return the real index that reflects F0 in air."""
    root = np.sqrt(np.clip(f0, 0, _MOST_F0))
    ior: FloatArray = (1 + root) / (1 - root)
    return ior


def _smooth_step(x: FloatArray) -> FloatArray:
    clipped = np.clip(x, 0, 1)
    grown: FloatArray = clipped**2 * (3 - 2 * clipped)
    return grown
