"""Facets of a rough surface, computed plainly: how many lean which way, and which of them light reaches.

D of equation 11 (Wu & Zheng 2015) and of its relatives, the projected area that Smith's masking divides by,
and G. Sources: Ashikhmin & Shirley 2000; Walter et al. 2007, "Microfacet models for refraction through rough
surfaces"; Heitz 2014, "Understanding the masking-shadowing function in microfacet-based BRDFs".

Directions are unit vectors (..., 3) with z along the normal; i and o point away from the surface.
"""

from collections.abc import Callable, Mapping
from functools import cache
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RectBivariateSpline
from scipy.special import beta, betainc, erf

FloatArray: TypeAlias = NDArray[np.float64]


class Surface(NamedTuple):
    """Facets and how they hide each other; the names are those of a spec."""

    distribution: str
    alpha_x: float
    alpha_y: float
    masking: str = "v-cavity"
    specular_weight: float = 1.0
    diffuse_weight: float = 0.0
    diffuse_reflectance: float = 0.0

    @property
    def exponents(self) -> tuple[float, float]:
        """e_x and e_y of equation 11: e = 2 / alpha^2 - 2."""
        return 2 / self.alpha_x**2 - 2, 2 / self.alpha_y**2 - 2


# ---- distribution of the facets ---------------------------------------------------------------------------


def density(surface: Surface, i: FloatArray, h: FloatArray) -> FloatArray:
    """D(h), 1/sr; the integral of D cos over the hemisphere is 1. Only Phong's depends on i."""
    return _DENSITIES[surface.distribution](surface, i, h)


def _ashikhmin_shirley(surface: Surface, _: FloatArray, h: FloatArray) -> FloatArray:
    """Equation 11. Its power is written so that it is smooth at h = n, where phi has no meaning."""
    e_x, e_y = surface.exponents
    sin_2 = h[..., 0] ** 2 + h[..., 1] ** 2
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = np.where(sin_2 > 0, np.log1p(-np.minimum(sin_2, 1)) / (2 * sin_2), -0.5)  # log cos / sin^2
        power = np.exp((e_x * h[..., 0] ** 2 + e_y * h[..., 1] ** 2) * slope)
    flat = (h[..., 2] <= 0) & (e_x * h[..., 0] ** 2 + e_y * h[..., 1] ** 2 > 0)
    return np.sqrt((e_x + 2) * (e_y + 2)) / (2 * np.pi) * np.where(flat, 0, np.nan_to_num(power, nan=1.0))


def _ggx(surface: Surface, _: FloatArray, h: FloatArray) -> FloatArray:
    """Trowbridge and Reitz; Walter et al. 2007, eq 33, stretched along x and y (Heitz 2014, eq 85)."""
    a_x, a_y = surface.alpha_x, surface.alpha_y
    stretched = (h[..., 0] / a_x) ** 2 + (h[..., 1] / a_y) ** 2 + h[..., 2] ** 2
    return 1 / (np.pi * a_x * a_y * stretched**2)


def _beckmann(surface: Surface, _: FloatArray, h: FloatArray) -> FloatArray:
    """Gaussian slopes; Walter et al. 2007, eq 25, stretched along x and y (Heitz 2014, eq 79)."""
    a_x, a_y = surface.alpha_x, surface.alpha_y
    cos_2 = np.maximum(h[..., 2], 1e-150) ** 2
    tan_2 = ((h[..., 0] / a_x) ** 2 + (h[..., 1] / a_y) ** 2) / cos_2
    return np.exp(-tan_2 - 2 * np.log(cos_2)) / (np.pi * a_x * a_y)


def _phong(surface: Surface, i: FloatArray, h: FloatArray) -> FloatArray:
    """After Sun 2006, with the lobe L of `phong_lobe`: f_r is L (cos_i + cos_o) G F / (2 cos_i cos_o).

    That is D = 4 L (i.h)(n.h), the smallest power of n.h with which no albedo exceeds 1.
    """
    cos_d = dot(i, h)
    return 4 * phong_lobe(surface, i, 2 * cos_d[..., None] * h - i) * cos_d * h[..., 2]


def phong_lobe(surface: Surface, i: FloatArray, o: FloatArray) -> FloatArray:
    """Phong's lobe (e + 1)/(2 pi) (r.o)^e about the mirror direction r of i; its integral over o is 1."""
    e, _ = surface.exponents
    cos = 2 * i[..., 2] * o[..., 2] - dot(i, o)
    return np.where(cos > 0, (e + 1) / (2 * np.pi) * np.maximum(cos, 0) ** e, 0)


_DENSITIES: Mapping[str, Callable[[Surface, FloatArray, FloatArray], FloatArray]] = MappingProxyType(
    {
        "ashikhmin-shirley": _ashikhmin_shirley,
        "blinn": _ashikhmin_shirley,
        "phong": _phong,
        "ggx": _ggx,
        "beckmann": _beckmann,
    }
)


# ---- projected area of the facets that a direction sees ---------------------------------------------------


def projected_area(surface: Surface, v: FloatArray) -> FloatArray:
    """Integral of D(h) max(v.h, 0) over the hemisphere: cos (1 + Lambda), Heitz 2014, eq 29 and 34."""
    return _AREAS[surface.distribution](surface, v)


def _ggx_area(surface: Surface, v: FloatArray) -> FloatArray:
    """Heitz 2014, eq 72 with eq 80's projected roughness."""
    cos = np.abs(v[..., 2])
    stretched = (surface.alpha_x * v[..., 0]) ** 2 + (surface.alpha_y * v[..., 1]) ** 2
    return (cos + np.sqrt(cos**2 + stretched)) / 2


def _beckmann_area(surface: Surface, v: FloatArray) -> FloatArray:
    """Heitz 2014, eq 66: cos (1 + erf a)/2 + spread exp(-a^2)/(2 sqrt pi), a = cos / spread."""
    cos = np.abs(v[..., 2])
    spread = np.hypot(surface.alpha_x * v[..., 0], surface.alpha_y * v[..., 1])
    a = np.divide(cos, spread, out=np.full_like(cos, np.inf), where=spread > 0)
    return cos * (1 + erf(a)) / 2 + spread * np.exp(-(a**2)) / (2 * np.sqrt(np.pi))


def _ashikhmin_shirley_area(surface: Surface, v: FloatArray) -> FloatArray:
    """Interpolate `_power_area` by splines: millions of directions of one surface are asked for."""
    spline, scale = _area_spline(surface._replace(masking="smith"))
    u = np.arcsinh(np.abs(v[..., 2]) / scale) / np.arcsinh(1 / scale)
    azimuth = np.arctan2(np.abs(v[..., 1]), np.abs(v[..., 0]))
    return np.asarray(spline(u, azimuth, grid=False))


@cache
def _area_spline(surface: Surface) -> tuple[RectBivariateSpline, float]:
    """Spline over (u, azimuth) with cos = scale sinh(u asinh(1 / scale)): fine where cos is near 0."""
    scale = min(surface.alpha_x, surface.alpha_y)
    u = np.linspace(0, 1, 161)
    cos = np.minimum(scale * np.sinh(u * np.arcsinh(1 / scale)), 1)
    isotropic = surface.alpha_x == surface.alpha_y
    step = np.pi / 2 / (8 if isotropic else 64)
    azimuth = np.arange(-4 * step, np.pi / 2 + 4.5 * step, step)  # beyond the ends by symmetry
    distinct = azimuth[:1] if isotropic else azimuth
    area = np.stack([_power_area(surface, cos, a) for a in distinct], axis=1)
    return RectBivariateSpline(u, azimuth, area + np.zeros_like(azimuth), kx=5, ky=5), scale


def _power_area(surface: Surface, cos: FloatArray, azimuth: float) -> FloatArray:
    """Projected area of equation 11 towards (cos, azimuth): exact over the tilt, Gauss over the azimuth.

    Up to there the integrals of cos^e sin^2 and cos^(e + 1) sin are an incomplete beta function and a power.
    """
    e_x, e_y = surface.exponents
    x, gauss = np.polynomial.legendre.leggauss(160)
    phi = np.pi / 2 * np.concatenate([x, x + 2])  # half a turn towards v, half a turn away from it
    weight = np.pi / 2 * np.concatenate([gauss, gauss])
    e = e_x * np.cos(azimuth + phi) ** 2 + e_y * np.sin(azimuth + phi) ** 2
    lean = np.sqrt((1 - cos) * (1 + cos))[..., None] * np.cos(phi)
    away = lean**2 / np.maximum(
        cos[..., None] ** 2 + lean**2, 1e-300
    )  # cos^2 of the steepest facet that faces v
    cos_2 = np.where(lean < 0, away, 0)
    a, b = 1.5, (e + 1) / 2
    towards = lean * beta(a, b) * betainc(a, b, 1 - cos_2) / 2
    upwards = cos[..., None] * (1 - cos_2 ** ((e + 2) / 2)) / (e + 2)
    return np.sqrt((e_x + 2) * (e_y + 2)) / (2 * np.pi) * ((towards + upwards) @ weight)


_AREAS: Mapping[str, Callable[[Surface, FloatArray], FloatArray]] = MappingProxyType(
    {
        "ashikhmin-shirley": _ashikhmin_shirley_area,
        "blinn": _ashikhmin_shirley_area,
        "ggx": _ggx_area,
        "beckmann": _beckmann_area,
    }
)


# ---- masking and shadowing --------------------------------------------------------------------------------


def masking_shadowing(surface: Surface, i: FloatArray, o: FloatArray, h: FloatArray) -> FloatArray:
    """G of a facet h that light meets along i and leaves along o, on whichever side."""
    return _MASKINGS[surface.masking](surface, i, o, h)


def _v_cavity(_: Surface, i: FloatArray, o: FloatArray, h: FloatArray) -> FloatArray:
    """Equation 13; the angle of each direction is that between it and the facet."""
    i_side, o_side = (2 * h[..., 2] * np.abs(v[..., 2]) / np.abs(dot(v, h)) for v in (i, o))
    return np.minimum(1, np.minimum(i_side, o_side))


def _smith(surface: Surface, i: FloatArray, o: FloatArray, _: FloatArray) -> FloatArray:
    """Height-correlated: 1 / (1 + Lambda_i + Lambda_o), Heitz 2014, eq 99; on both sides alike."""
    return 1 / (_hidden(surface, i) + _hidden(surface, o) - 1)


def _smith_separable(surface: Surface, i: FloatArray, o: FloatArray, _: FloatArray) -> FloatArray:
    """Product of the two maskings, Walter et al. 2007, eq 23; Heitz 2014, eq 98."""
    return 1 / (_hidden(surface, i) * _hidden(surface, o))


def _hidden(surface: Surface, v: FloatArray) -> FloatArray:
    """1 / G1 = 1 + Lambda."""
    return projected_area(surface, v) / np.maximum(np.abs(v[..., 2]), 1e-300)


_MASKINGS: Mapping[str, Callable[[Surface, FloatArray, FloatArray, FloatArray], FloatArray]] = (
    MappingProxyType({"v-cavity": _v_cavity, "smith": _smith, "smith-separable": _smith_separable})
)


def dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """Scalar product of directions (..., 3)."""
    return np.einsum("...k,...k->...", a, b)


def unit(v: FloatArray) -> FloatArray:
    """Scale vectors (..., 3) to length 1."""
    return v / np.linalg.norm(v, axis=-1, keepdims=True)
