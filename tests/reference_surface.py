"""A rough surface computed slowly and plainly: the reference that the microfacet kernels are tested against.

Equation 12 of Wu & Zheng 2015, its transmitted counterpart of Walter et al. 2007, and their integrals by
brute force. The film of every sample is that of reference.py at the sample's own angle: nothing is tabulated,
or factorised over wavelength.

Directions are unit vectors (..., 3) with z along the normal; i and o point away from the surface, o of a
transmitted ray downwards. Every f is without the cosine, 1/sr. Transmission counts flux: the integral of f_t
cos_o over the lower hemisphere is the transmitted share, and a renderer of radiance scales it itself.
"""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reference import film
from reference_facets import Surface, density, dot, masking_shadowing, phong_lobe, unit

FloatArray: TypeAlias = NDArray[np.float64]

TRANSMITS_BELOW_K = 1e-3
"""A substrate with a larger k lets no light out of it: f_t = 0."""


class Coating(NamedTuple):
    """What every facet is coated with; the fields are the parameters of `reference.film`."""

    index: NDArray[np.complex128]  # (M+2, L)
    thickness_nm: FloatArray  # (M,)
    wavelength_nm: FloatArray  # (L,)

    def intensities(self, cos_theta_d: FloatArray) -> tuple[FloatArray, FloatArray]:
        """R and T for unpolarised light, (..., L), at the angles between light and facet."""
        of = film(self.index, self.thickness_nm, self.wavelength_nm, np.clip(cos_theta_d.ravel(), 0, 1))
        shape = (*cos_theta_d.shape, -1)
        return ((of.R_s + of.R_p) / 2).reshape(shape), ((of.T_s + of.T_p) / 2).reshape(shape)

    def at(self, position: int) -> "Coating":
        """Return the same film at one of its wavelengths."""
        return Coating(self.index[:, [position]], self.thickness_nm, self.wavelength_nm[[position]])


def mirror(wavelengths: int = 1) -> Coating:
    """R = 1 at every angle, the white furnace: a substrate so dense that 1e-9 is lost."""
    return Coating(
        np.array([np.ones(wavelengths), np.full(wavelengths, 1e-9 + 1e9j)]),
        np.zeros(0),
        np.linspace(400, 700, wavelengths),
    )


# ---- reflection and transmission --------------------------------------------------------------------------


def f_r(surface: Surface, coating: Coating, i: FloatArray, o: FloatArray) -> FloatArray:
    """Reflection, equation 12, (..., L): i and o (..., 3) are both above the surface."""
    R, _ = coating.intensities(dot(i, _half_vector(i, o)))
    lambertian = surface.diffuse_weight * surface.diffuse_reflectance / np.pi
    return lambertian + surface.specular_weight * white_f_r(surface, i, o)[..., None] * R


def white_f_r(surface: Surface, i: FloatArray, o: FloatArray) -> FloatArray:
    """D G / (4 cos_i cos_o), (...): equation 12's specular part of a film with R = 1."""
    i, o = np.broadcast_arrays(i, o)
    h = _half_vector(i, o)
    above = (i[..., 2] > 0) & (o[..., 2] > 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        geometry = density(surface, i, h) * masking_shadowing(surface, i, o, h)
        return np.where(above, geometry / (4 * i[..., 2] * o[..., 2]), 0)


def _half_vector(i: FloatArray, o: FloatArray) -> FloatArray:
    return unit(i + o)


def f_t(surface: Surface, coating: Coating, i: FloatArray, o: FloatArray) -> FloatArray:
    """Transmission into the substrate, Walter et al. 2007, eq 21, (..., L): o (..., 3) points downwards."""
    i, o = np.broadcast_arrays(i, o)
    n_i, n_o = coating.index[0].real, coating.index[-1].real
    one_by_one = [
        _one_f_t(surface, coating.at(w), i, o) for w in range(len(coating.wavelength_nm))
    ]  # every wavelength is bent by its own index
    transmits = (coating.index[-1].imag < TRANSMITS_BELOW_K) & (n_i > 0) & (n_o > 0)
    return surface.specular_weight * np.where(transmits, np.stack(one_by_one, axis=-1), 0)


def _one_f_t(surface: Surface, coating: Coating, i: FloatArray, o: FloatArray) -> FloatArray:
    n_i, n_o = coating.index[0, 0].real, coating.index[-1, 0].real
    h = refraction_half_vector(i, o, n_i, n_o)
    cos_i, cos_o = dot(i, h), dot(o, h)
    refracts = (i[..., 2] > 0) & (o[..., 2] < 0) & (cos_i > 0) & (cos_o < 0)
    _, T = coating.intensities(np.where(refracts, cos_i, 1))
    with np.errstate(divide="ignore", invalid="ignore"):
        geometry = density(surface, i, h) * masking_shadowing(surface, i, o, h) * cos_i
        value = geometry * refraction_jacobian(i, o, h, n_i, n_o) / np.abs(i[..., 2] * o[..., 2])
    return np.where(refracts, value * T[..., 0], 0)


def refraction_half_vector(i: FloatArray, o: FloatArray, n_i: float, n_o: float) -> FloatArray:
    """Return the facet normal, upwards, that bends i into o: Walter et al. 2007, eq 16."""
    h = unit(n_i * i + n_o * o)
    return h * np.where(h[..., 2:] < 0, -1, 1)


def refraction_jacobian(i: FloatArray, o: FloatArray, h: FloatArray, n_i: float, n_o: float) -> FloatArray:
    """Solid angle of h for one of o: Walter et al. 2007, eq 17."""
    cos_i, cos_o = dot(i, h), dot(o, h)
    return n_o**2 * np.abs(cos_o) / (n_i * cos_i + n_o * cos_o) ** 2


def kulla_conty(E_i: ArrayLike, E_o: ArrayLike, E_mean: ArrayLike, F_mean: ArrayLike) -> FloatArray:
    """Reflection after several bounces, Kulla & Conty 2017 with the colour of Hill 2018, 1/sr.

    E_i and E_o are the white single-scattering albedos of the two directions, E_mean and F_mean the
    cosine-weighted means of that albedo and of the film's R.
    """
    E_i, E_o, E_mean, F_mean = np.broadcast_arrays(E_i, E_o, E_mean, F_mean)
    shape = (1 - E_i) * (1 - E_o) / (np.pi * (1 - E_mean))
    return shape * F_mean**2 * E_mean / (1 - F_mean * (1 - E_mean))


# ---- albedo by brute force --------------------------------------------------------------------------------


def white_albedo(surface: Surface, cos_theta_i: float, nodes: int = 512) -> float:
    """Directional albedo E of D and G alone, by midpoints of the facets that `sample_reflection` gives.

    They are dense in the square root of the share of steeper facets, of which GGX has a long tail. An
    anisotropic surface is lit from 32 azimuths of a quarter turn; the other quarters mirror it.
    """
    azimuths = 1 if surface.alpha_x == surface.alpha_y else 32
    turn, rest, phi = ((np.arange(count) + 0.5) / count for count in (nodes, nodes, azimuths))
    u = np.array(np.meshgrid(1 - rest**2, turn, phi / 4, indexing="ij"))
    share = 2 * np.sqrt(1 - u[0])  # of a midpoint; the mean is 1
    i = _incident(cos_theta_i, u[2])
    o = sample_reflection(surface, i, u[:2])
    upper = o[..., 2] > 0
    i, o = i[upper], o[upper]
    weights = share[upper] * white_f_r(surface, i, o) * o[..., 2] / reflection_pdf(surface, i, o)
    return float(weights.sum() / u[0].size)


class Albedo(NamedTuple):
    """Directional albedos and their standard errors, each (L,)."""

    E_r: FloatArray
    E_t: FloatArray
    sigma_r: FloatArray
    sigma_t: FloatArray


def monte_carlo_albedo(
    surface: Surface, coating: Coating, cos_theta_i: float, samples: int, seed: int
) -> Albedo:
    """Equation 12 integrated over o by sampling o: by cosine, by the facets, and by facets of any tilt.

    The weight of a sample is f cos_o over the mixed density (the balance heuristic, Veach 1997, section 9.2):
    no lobe is missed, and steep facets, which grazing light sees more than D cos has them, weigh no more than
    others. An anisotropic surface is lit from all azimuths alike. The samples are `REPLICATES` independent
    estimates, whose scatter is the standard error.
    """
    rng = np.random.default_rng(seed)
    E_r, sigma_r = _reflected(surface, coating, cos_theta_i, _evenly(samples, rng))
    columns = [
        _transmitted(surface, coating.at(w), cos_theta_i, _evenly(samples, rng))
        for w in range(len(coating.wavelength_nm))
    ]
    E_t, sigma_t = np.array(columns).T
    return Albedo(E_r, E_t, sigma_r, sigma_t)


REPLICATES = 32
"""Independent estimates; their mean over its standard error is Student's t of 31 degrees of freedom."""
SHARES = (0.25, 0.125, 0.625)
"""Samples by cosine, by facets of any tilt, and by facets with density D cos."""


def _evenly(samples: int, rng: np.random.Generator) -> FloatArray:
    """Uniform numbers (3, REPLICATES, n), even within a replicate: a sequence shifted at random.

    Each point by itself is uniform, so that a replicate is unbiased (Cranley & Patterson 1976). The steps are
    powers of the root of x^4 = x + 1, an additive recurrence of low discrepancy.
    """
    steps = 1.2207440846057596 ** -np.arange(1.0, 4)[:, None, None]
    shift = rng.random((3, REPLICATES, 1))
    count = 8 * -(-samples // (8 * REPLICATES))  # SHARES are eighths, and hold exactly
    return (shift + steps * np.arange(count)) % 1


def _chosen(*candidates: FloatArray) -> FloatArray:
    """Take every sample (K, n, 3) from one of the candidates: as many of each, in a row, as `SHARES` says.

    A run of the sequence is as even as the whole; every eighth of its points need not be.
    """
    n = candidates[0].shape[1]
    place = (np.arange(n) + 0.5)[:, None] / n
    return np.select([place < SHARES[0], place < SHARES[0] + SHARES[1]], candidates[:2], candidates[2])


def _mixed(*densities: FloatArray) -> FloatArray:
    return np.tensordot(SHARES, densities, axes=1)


def _reflected(surface: Surface, coating: Coating, mu: float, u: FloatArray) -> tuple[FloatArray, FloatArray]:
    i = _incident(mu, u[2])
    o = _chosen(
        cosine_direction(u[:2]),
        reflected(i, uniform_direction(u[:2])),
        sample_reflection(surface, i, u[:2]),
    )
    upper = o[..., 2] > 0
    i, o = i[upper], o[upper]
    of_any_tilt = 1 / (8 * np.pi * dot(i, _half_vector(i, o)))
    pdf = _mixed(o[..., 2] / np.pi, of_any_tilt, reflection_pdf(surface, i, o))
    weights = np.zeros((*upper.shape, len(coating.wavelength_nm)))
    weights[upper] = f_r(surface, coating, i, o) * (o[..., 2] / pdf)[..., None]
    return _mean_and_error(weights)


def _transmitted(surface: Surface, coating: Coating, mu: float, u: FloatArray) -> tuple[float, float]:
    n_i, n_o = coating.index[0, 0].real, coating.index[-1, 0].real
    if surface.distribution == "phong" or coating.index[-1, 0].imag >= TRANSMITS_BELOW_K:
        return 0.0, 0.0
    i = _incident(mu, u[2])
    o = _chosen(
        cosine_direction(u[:2]) * [1, 1, -1],
        refracted(i, uniform_direction(u[:2]), n_i, n_o),
        sample_refraction(surface, i, u[:2], n_i, n_o),
    )
    lower = o[..., 2] < 0
    i, o = i[lower], o[lower]
    of_facets, of_any_tilt = (pdf(surface, i, o, n_i, n_o) for pdf in (refraction_pdf, _any_refraction_pdf))
    pdf = _mixed(-o[..., 2] / np.pi, of_any_tilt, of_facets)
    weights = np.zeros((*lower.shape, 1))
    weights[lower] = f_t(surface, coating, i, o) * (-o[..., 2] / pdf)[..., None]
    mean, error = _mean_and_error(weights)
    return float(mean[0]), float(error[0])


def _mean_and_error(weights: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean and standard error of weights (REPLICATES, n, L), each (L,)."""
    replicates = weights.mean(axis=1)
    return replicates.mean(axis=0), replicates.std(axis=0, ddof=1) / np.sqrt(REPLICATES)


def _incident(mu: float, u: FloatArray) -> FloatArray:
    phi = 2 * np.pi * u
    sin = np.sqrt((1 - mu) * (1 + mu))
    return np.stack([sin * np.cos(phi), sin * np.sin(phi), np.full_like(phi, mu)], axis=-1)


def cosine_direction(u: FloatArray) -> FloatArray:
    """Directions (..., 3) with density cos / pi from two uniform numbers (2, ...)."""
    phi, sin = 2 * np.pi * u[1], np.sqrt(u[0])
    return np.stack([sin * np.cos(phi), sin * np.sin(phi), np.sqrt(1 - u[0])], axis=-1)


def uniform_direction(u: FloatArray) -> FloatArray:
    """Directions (..., 3) above the surface with density 1 / (2 pi)."""
    sin, phi = np.sqrt(u[0] * (2 - u[0])), 2 * np.pi * u[1]
    return np.stack([sin * np.cos(phi), sin * np.sin(phi), 1 - u[0]], axis=-1)


def sample_facet(surface: Surface, u: FloatArray) -> FloatArray:
    """Facet normals (..., 3) with density D cos from two uniform numbers (2, ...)."""
    return _FACET_SAMPLERS[surface.distribution](surface, u)


def _power_facet(surface: Surface, u: FloatArray) -> FloatArray:
    """Invert D cos of equation 11: as Ashikhmin & Shirley 2000, eq 9 and 10, with e + 1 for e."""
    e_x, e_y = surface.exponents
    turn = 2 * np.pi * u[1]
    x, y = np.sqrt(e_y + 2) * np.cos(turn), np.sqrt(e_x + 2) * np.sin(turn)
    cos_phi, sin_phi = x / np.hypot(x, y), y / np.hypot(x, y)
    log_cos = np.log1p(-u[0]) / (e_x * cos_phi**2 + e_y * sin_phi**2 + 2)
    sin = np.sqrt(-np.expm1(2 * log_cos))
    return np.stack([sin * cos_phi, sin * sin_phi, np.exp(log_cos)], axis=-1)


def _ggx_facet(surface: Surface, u: FloatArray) -> FloatArray:
    """Slopes of Walter et al. 2007, eq 35 and 36, stretched."""
    return _facet_of_slope(surface, np.sqrt(u[0] / (1 - u[0])), u[1])


def _beckmann_facet(surface: Surface, u: FloatArray) -> FloatArray:
    """Slopes of Walter et al. 2007, eq 28 and 29, stretched."""
    return _facet_of_slope(surface, np.sqrt(-np.log1p(-u[0])), u[1])


def _facet_of_slope(surface: Surface, tan: FloatArray, turn: FloatArray) -> FloatArray:
    x = surface.alpha_x * tan * np.cos(2 * np.pi * turn)
    y = surface.alpha_y * tan * np.sin(2 * np.pi * turn)
    return unit(np.stack([x, y, np.ones_like(x)], axis=-1))


_FACET_SAMPLERS: Mapping[str, Callable[[Surface, FloatArray], FloatArray]] = MappingProxyType(
    {
        "ashikhmin-shirley": _power_facet,
        "blinn": _power_facet,
        "ggx": _ggx_facet,
        "beckmann": _beckmann_facet,
    }
)


def sample_reflection(surface: Surface, i: FloatArray, u: FloatArray) -> FloatArray:
    """Reflected directions (N, 3), some of them below the surface, with density `reflection_pdf`."""
    if surface.distribution == "phong":
        return _sample_lobe(surface, i, u)
    return reflected(i, sample_facet(surface, u))


def reflected(i: FloatArray, h: FloatArray) -> FloatArray:
    """Return i reflected by the facet h, Walter et al. 2007, eq 39."""
    return 2 * dot(i, h)[..., None] * h - i


def reflection_pdf(surface: Surface, i: FloatArray, o: FloatArray) -> FloatArray:
    """Density over o: D cos_h / (4 i.h), Walter et al. 2007, eq 14 and 24; Phong's lobe itself."""
    if surface.distribution == "phong":
        return phong_lobe(surface, i, o)
    h = _half_vector(i, o)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(h[..., 2] > 0, density(surface, i, h) * h[..., 2] / (4 * dot(i, h)), 0)


def _sample_lobe(surface: Surface, i: FloatArray, u: FloatArray) -> FloatArray:
    """Directions about the mirror direction r of i, in any frame whose z is r."""
    r = i * [-1, -1, 1]
    e, _ = surface.exponents
    cos, phi = (1 - u[0]) ** (1 / (e + 1)), 2 * np.pi * u[1]
    x_axis = unit(np.cross(r, [0.6, 0.64, 0.48]))
    across = np.cos(phi)[..., None] * x_axis + np.sin(phi)[..., None] * np.cross(r, x_axis)
    return np.sqrt((1 - cos) * (1 + cos))[..., None] * across + cos[..., None] * r


def sample_refraction(surface: Surface, i: FloatArray, u: FloatArray, n_i: float, n_o: float) -> FloatArray:
    """Refracted directions (..., 3) with density `refraction_pdf`, as `refracted` gives them."""
    return refracted(i, sample_facet(surface, u), n_i, n_o)


def refracted(i: FloatArray, h: FloatArray, n_i: float, n_o: float) -> FloatArray:
    """Return i bent by the facet h, Walter et al. 2007, eq 40; straight up where light does not pass."""
    cos, ratio = dot(i, h), n_i / n_o
    radicand = 1 + ratio**2 * (cos**2 - 1)
    passes = (cos > 0) & (radicand > 0)
    o = (ratio * cos - np.sqrt(np.maximum(radicand, 0)))[..., None] * h - ratio * i
    return np.where(passes[..., None], o, [0.0, 0.0, 1.0])


def refraction_pdf(surface: Surface, i: FloatArray, o: FloatArray, n_i: float, n_o: float) -> FloatArray:
    """Density over o: D cos_h times the Jacobian, 0 where no facet bends i into o."""
    h = refraction_half_vector(i, o, n_i, n_o)
    with np.errstate(divide="ignore", invalid="ignore"):
        facets = density(surface, i, h) * h[..., 2]
    any_tilt = _any_refraction_pdf(surface, i, o, n_i, n_o)
    return np.where(any_tilt > 0, 2 * np.pi * any_tilt * facets, 0)


def _any_refraction_pdf(_: Surface, i: FloatArray, o: FloatArray, n_i: float, n_o: float) -> FloatArray:
    """Density over o of facets of any tilt, 1 / (2 pi), times the Jacobian."""
    h = refraction_half_vector(i, o, n_i, n_o)
    refracts = (dot(i, h) > 0) & (dot(o, h) < 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(refracts, refraction_jacobian(i, o, h, n_i, n_o) / (2 * np.pi), 0)
