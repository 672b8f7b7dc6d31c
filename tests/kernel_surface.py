"""Rough surfaces for the tests of the kernels: which there are, specs and solvers of them, and cubatures.

The cubatures are written here and share nothing with the quadrature of the code under test.
"""

from collections.abc import Mapping
from functools import cache
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.microsurface import Microsurface, microsurface
from nacreous.tables.albedo.solver import AlbedoSolver
from nacreous.tables.bsdf.solver import BsdfSolver, bsdf_solver
from nacreous.tables.spec import Spec
from reference_facets import FloatArray, Surface
from reference_surface import Coating, white_f_r

MASKINGS = ("v-cavity", "smith", "smith-separable")
FACETS = ("ashikhmin-shirley", "blinn", "ggx", "beckmann")
"""Every distribution but Phong's, which is a lobe."""
COMBINATIONS = (*product(FACETS, MASKINGS), ("phong", "v-cavity"))
"""Distributions and maskings that a spec may have."""
ISOTROPIC = ("blinn", "phong")
ROUGH = (0.02, 0.05, 0.1, 0.25, 0.5, 1.0)
STRETCHED = ((0.02, 0.2), (0.2, 0.02), (1.0, 0.1), (0.1, 1.0), (0.3, 0.5))
"""Roughnesses along x and y, of ratios to 10."""

VISIBLE = {"start": 400, "stop": 700, "step": 100}
GLASS = {"n": 1.5}
CLEAR = {"material": {"n": 2.0}, "thickness_nm": 300}
"""A layer that absorbs nothing."""


def alphas_of(distribution: str) -> FloatArray:
    """Roughnesses that a distribution is tried at, (R, 2)."""
    even = [(alpha, alpha) for alpha in ROUGH]
    return np.array(even if distribution in ISOTROPIC else [*even, *STRETCHED])


def facets_of(device: Device, distribution: str, masking: str, *alphas: float) -> Microsurface:
    """Return the surface of one roughness, its `alphas` along x and y, or along both."""
    return microsurface(device, distribution, masking, np.array([[alphas[0], alphas[-1]]]))


def rough_spec(
    surface: Mapping[str, Any], *layers: Mapping[str, Any], substrate: object = GLASS, **table: object
) -> Spec:
    """Return the spec of a rough surface on a substrate, in vacuum; four wavelengths unless `table` says."""
    stack = {"incident": "vacuum", "substrate": substrate, "layers": list(layers or (CLEAR,))}
    axes = {"quantity": "albedo", "wavelength_nm": VISIBLE, **table}
    return Spec.model_validate({"stack": stack, "surface": dict(surface), "table": axes})


def solvers_of(device: Device, spec: Spec) -> tuple[AlbedoSolver, BsdfSolver]:
    """Return what a spec's albedo and its BSDF are computed with, as `nacreous.tables` makes them."""
    bsdf = bsdf_solver(device, spec)
    return bsdf.albedo, bsdf


# ---- directions and cubatures -----------------------------------------------------------------------------


def random_directions(count: int, seed: int, least: float = 0.02) -> FloatArray:
    """Return unit vectors (count, 3) above the surface, equally dense, of cosine `least` or more."""
    rng = np.random.default_rng(seed)
    return directions_of(rng.uniform(least, 1, count), rng.uniform(-np.pi, np.pi, count))


def directions_of(cosine: FloatArray, phi: FloatArray) -> FloatArray:
    """Return unit vectors (..., 3)."""
    sine = np.sqrt((1 - cosine) * (1 + cosine))
    return np.stack(np.broadcast_arrays(sine * np.cos(phi), sine * np.sin(phi), cosine), axis=-1)


@cache
def _gauss(count: int) -> tuple[FloatArray, FloatArray]:
    """Return nodes in [-1, 1] and weights; they take longer than most sums over them."""
    return np.polynomial.legendre.leggauss(count)


@cache
def hemisphere(tilts: int = 96, azimuths: int = 192) -> tuple[FloatArray, FloatArray]:
    """Directions (N, 3) and solid angles (N,): Gauss-Legendre over the angle, midpoints around."""
    nodes, gauss = _gauss(tilts)
    theta, weight = np.pi / 4 * (nodes + 1), np.pi / 4 * gauss
    phi = 2 * np.pi * (np.arange(azimuths) + 0.5) / azimuths
    directions = directions_of(np.cos(theta)[:, None], phi)
    solid_angle = np.broadcast_to((np.sin(theta) * weight)[:, None] * 2 * np.pi / azimuths, (tilts, azimuths))
    return directions.reshape(-1, 3), solid_angle.ravel()


@cache
def stretched_hemisphere(
    alphas: tuple[float, float], tilts: int = 192, azimuths: int = 96
) -> tuple[FloatArray, FloatArray]:
    """Facets (N, 3) and solid angles (N,), dense where a surface's facets are: polar coordinates of slopes.

    A slope is r (alpha_x cos, alpha_y sin), r = (u / (1 - u))^2, Gauss-Legendre in u and midpoints around; a
    facet's solid angle is cos^3 times the area that its slope takes.
    """
    nodes, gauss = _gauss(tilts)
    u = (nodes + 1) / 2
    r, dr = (u / (1 - u)) ** 2, gauss * u / (1 - u) ** 3
    phi = 2 * np.pi * (np.arange(azimuths) + 0.5) / azimuths
    x, y = alphas[0] * r[:, None] * np.cos(phi), alphas[1] * r[:, None] * np.sin(phi)
    z = 1 / np.sqrt(1 + x**2 + y**2)
    area = alphas[0] * alphas[1] * (r * dr)[:, None] * 2 * np.pi / azimuths
    facets = np.stack([x * z, y * z, z], axis=-1)
    return facets.reshape(-1, 3), (z**3 * area).ravel()


def reflected(i: FloatArray, facets: FloatArray) -> FloatArray:
    """Directions (N, 3) into which facets (N, 3) reflect light from i (3,)."""
    return 2 * (facets @ i)[:, None] * facets - i


def mirrored_flux(surface: Surface, mu: float, phi: float = 0.0) -> tuple[FloatArray, FloatArray]:
    """Cosine at the facet and share of the light, (N,), of every facet of a cubature: f_r cos_o d omega_o."""
    i = directions_of(np.array(mu), np.array(phi))
    h, solid_angle = stretched_hemisphere((surface.alpha_x, surface.alpha_y), 256, 128)
    o = reflected(i, h)
    seen = (h @ i > 1e-9) & (o[:, 2] > 0)
    h, o, solid_angle = h[seen], o[seen], solid_angle[seen]
    share = white_f_r(surface, i, o) * o[:, 2] * 4 * (h @ i) * solid_angle  # d omega_o = 4 i.h d omega_h
    return h @ i, share


class FacetAlbedo:
    """E_r of a film on facets by cubature: the film is that of reference.py at closely spaced cosines."""

    def __init__(self, coating: Coating, nodes: int = 513) -> None:
        self._film, _ = coating.intensities(np.linspace(0, 1, nodes))  # (nodes, L)

    def at(self, surface: Surface, mu: float) -> FloatArray:
        """E_r at one angle of incidence, (L,)."""
        cosine, share = mirrored_flux(surface, mu)
        place = np.clip(cosine, 0, 1) * (len(self._film) - 1)
        first = np.minimum(place.astype(int), len(self._film) - 2)
        upper = place - first
        count = len(self._film)
        weights = np.bincount(first, share * (1 - upper), count) + np.bincount(
            first + 1, share * upper, count
        )
        return np.asarray(weights @ self._film)


def integrated(solver: BsdfSolver, side: Side, cos_theta: float, nm: NDArray[np.float64]) -> FloatArray:
    """Integral of f_r or f_t times cos_o over the directions o on its side, at the first roughness: (L,)."""
    o, solid_angle = hemisphere()
    i = np.tile(directions_of(np.array(cos_theta), np.array(0.0)), (len(o), 1))
    flux = o[:, 2] * solid_angle
    if side is Side.TRANSMISSION:
        return np.asarray(flux @ solver.transmission(0, i, o * [1, 1, -1], nm))
    return np.asarray(flux @ solver.reflection(0, i, o, nm))
