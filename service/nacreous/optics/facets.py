"""Facets of a rough surface as a quadrature: directions whose weights follow D cos.

A sum over the facets of weight times g is the integral of D(h) cos(h) g(h) over the hemisphere, for every
roughness with the same effort: the distribution is inverted, not searched. Sources: Ashikhmin and Shirley
2000, eq 6 to 9, with the exponents of D cos; Walter et al. 2007, eq 28 and 35.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from nacreous.optics.quadrature import gauss_legendre

__all__ = ["FacetRule", "facet_quadrature", "incident_azimuths", "is_isotropic"]

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class FacetRule:
    """How many facets a quadrature takes.

    Parameters
    ----------
    tilts : int
        Over the tilt.
    directions : int
        Over half a circle of azimuths, an even number.
    incidence : int
        Azimuths of the incident light over a quarter, for an anisotropic surface.
    """

    tilts: int
    directions: int
    incidence: int

    def doubled(self) -> "FacetRule":
        """Return the rule with twice as many of everything."""
        return FacetRule(2 * self.tilts, 2 * self.directions, 2 * self.incidence)

    def facets(self, alphas: FloatArray) -> int:
        """Facets at each of the roughnesses `alphas`, (R, 2), and for each azimuth of the light."""
        return self.tilts * self.directions * (1 if is_isotropic(alphas) else 2)


def incident_azimuths(alphas: FloatArray, rule: FacetRule) -> FloatArray:
    """Return the azimuths in radians that an albedo is averaged over, (P,): a quarter's, by symmetry.

    One, 0, where all `alphas`, shape (R, 2), are isotropic.
    """
    if is_isotropic(alphas):
        return np.zeros(1)
    return np.pi / 2 * (np.arange(rule.incidence) + 0.5) / rule.incidence


def facet_quadrature(distribution: str, alphas: FloatArray, rule: FacetRule, phi: float = 0.0) -> FloatArray:
    """Return x, y, z and weight of the facets, shape (R, 4, N); weights have the sum 1.

    For ``"phong"`` they are directions about the mirror direction instead, with the weight of the lobe.

    Gauss-Legendre in the square root of the share of steeper facets, and in azimuth on either side of the
    facets that light from an incident azimuth grazes, about which the nodes are dense: where light comes in
    flat, all that masking does happens there. 128 tilts by 32 directions are within 1e-4 of the albedo of a
    mirror's facets for every distribution and masking, alpha from 0.02 to 1, at any angle.

    Parameters
    ----------
    distribution : str
        As the surface names it.
    alphas : float array, shape (R, 2)
        Along x and y. Where both are equal everywhere the facets are those of a half circle, y > 0: the
        light comes in the plane y = 0.
    phi : float
        Azimuth of the light that they are for, in radians.
    """
    rest, gauss = gauss_legendre(rule.tilts)  # square root of the share of steeper facets
    log_steeper, tilt_weight = 2 * np.log(rest), 2 * gauss * rest
    turn, turn_weight = _turns(alphas, rule, phi)  # (R, directions), (directions,)
    tilt, along_x, along_y = _INVERSES[distribution](
        log_steeper[:, None], turn[:, None], alphas[:, :, None, None]
    )  # (R, tilts, directions)
    z = 1 / np.sqrt(1 + tilt)
    flat = np.sqrt(tilt) * z
    weights = np.broadcast_to(tilt_weight[:, None] * turn_weight, z.shape)
    facets = np.stack([flat * along_x, flat * along_y, z, weights], axis=1)
    return facets.reshape(*facets.shape[:2], -1)


def is_isotropic(alphas: FloatArray) -> bool:
    """Tell whether surfaces of `alphas`, shape (R, 2), look the same from any azimuth."""
    return bool((alphas[:, 0] == alphas[:, 1]).all())


def _turns(alphas: FloatArray, rule: FacetRule, phi: float) -> tuple[FloatArray, FloatArray]:
    """Return angles (R, directions) on the circle whose stretching by alpha gives slopes, and weights.

    Facets of slopes t (alpha_x cos, alpha_y sin) are grazed by flat light from the azimuth phi a quarter turn
    away from atan2(alpha_y sin phi, alpha_x cos phi).
    """
    distance, gauss = gauss_legendre(rule.directions // 2)
    beside = np.pi / 2 * distance**2
    turn = np.concatenate([np.pi / 2 - beside, np.pi / 2 + beside])
    weight = np.tile(gauss * distance, 2)
    if not is_isotropic(alphas):
        turn, weight = np.concatenate([turn, turn + np.pi]), np.tile(weight, 2) / 2
    grazed = np.arctan2(alphas[:, 1:] * np.sin(phi), alphas[:, :1] * np.cos(phi))  # (R, 1)
    return grazed + turn, weight


# ---- tan^2 of the tilt, and the unit vector of its azimuth -------------------------------------------------

_Inverse = Callable[[FloatArray, FloatArray, FloatArray], tuple[FloatArray, FloatArray, FloatArray]]


def _stretched(turn: FloatArray, alphas: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the length squared and the unit vector of a circle stretched by alpha, (R, 1, directions)."""
    x, y = alphas[:, 0] * np.cos(turn), alphas[:, 1] * np.sin(turn)
    length2 = x**2 + y**2
    return length2, x / np.sqrt(length2), y / np.sqrt(length2)


def _ggx(
    log_steeper: FloatArray, turn: FloatArray, alphas: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    alpha2, x, y = _stretched(turn, alphas)
    return alpha2 * np.expm1(-log_steeper), *_filled(x, y, log_steeper)


def _beckmann(
    log_steeper: FloatArray, turn: FloatArray, alphas: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    alpha2, x, y = _stretched(turn, alphas)
    return -alpha2 * log_steeper, *_filled(x, y, log_steeper)


def _ashikhmin_shirley(
    log_steeper: FloatArray, turn: FloatArray, alphas: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    # cos^(e + 2) is the share of steeper facets, e + 2 = 2 (cos^2 phi / alpha_x^2 + sin^2 phi / alpha_y^2).
    # Phi is that of the stretched circle, where e + 2 is 2 over its length squared.
    alpha2, x, y = _stretched(turn, alphas)
    return np.expm1(-alpha2 * log_steeper), *_filled(x, y, log_steeper)


def _phong(
    log_steeper: FloatArray, turn: FloatArray, alphas: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    # cos^(e + 1) about the mirror direction, e + 1 = 2 / alpha^2 - 1.
    _, x, y = _stretched(turn, alphas)
    alpha2 = alphas[:, 0] ** 2
    return np.expm1(-2 * log_steeper * alpha2 / (2 - alpha2)) + 0 * turn, *_filled(x, y, log_steeper)


def _filled(x: FloatArray, y: FloatArray, log_steeper: FloatArray) -> tuple[FloatArray, FloatArray]:
    return x + 0 * log_steeper, y + 0 * log_steeper


_INVERSES: Mapping[str, _Inverse] = MappingProxyType(
    {
        "ashikhmin-shirley": _ashikhmin_shirley,
        "blinn": _ashikhmin_shirley,
        "phong": _phong,
        "ggx": _ggx,
        "beckmann": _beckmann,
    }
)
