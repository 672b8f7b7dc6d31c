"""Pairs of directions by half and difference vector (S. Rusinkiewicz 1998), of an isotropic surface.

theta_h is the angle of the half vector h to the normal. In the frame of h the incoming direction has the
polar angle theta_d and the azimuth phi_d, counted from where theta_h grows:

    h = (sin theta_h, 0, cos theta_h),  t = (cos theta_h, 0, -sin theta_h),  b = (0, 1, 0)
    i, o = cos theta_d h +- sin theta_d (cos phi_d t + sin phi_d b)

The lower of both directions has the cosine cos theta_h cos theta_d - sin theta_h sin theta_d |cos phi_d|, so
that a grid over the three angles has places that no light above the surface reaches.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.bsdf import Pairs

__all__ = ["HalfDifference", "half_difference_of", "lower_cosine"]

FloatArray = NDArray[np.float64]

GRAZING = 1e-3
"""Least cosine to the normal at which a bsdf is evaluated."""
_STEEPEST_HALF = np.arccos(2 * GRAZING)


@dataclass(frozen=True, eq=False)
class HalfDifference:
    """Angles in radians, each of shape (P,).

    Parameters
    ----------
    theta_h, theta_d, phi_d : float arrays, shape (P,)
    """

    theta_h: FloatArray
    theta_d: FloatArray
    phi_d: FloatArray

    @classmethod
    def grid(cls, theta_h: FloatArray, theta_d: FloatArray, phi_d: FloatArray) -> "HalfDifference":
        """Return every combination, flat, phi_d fastest and theta_h slowest."""
        return cls(*(angle.ravel() for angle in np.meshgrid(theta_h, theta_d, phi_d, indexing="ij")))

    def above(self) -> "HalfDifference":
        """Return the nearest angles whose directions are above the surface: theta_d is as large as it may be.

        cos theta_h cos theta_d - sin theta_h |cos phi_d| sin theta_d is s cos(theta_d + psi).
        """
        theta_h = np.minimum(self.theta_h, _STEEPEST_HALF)
        across, along = np.cos(theta_h), np.sin(theta_h) * np.abs(np.cos(self.phi_d))
        psi = np.arctan2(along, across)
        flattest = np.arccos(GRAZING / np.hypot(across, along)) - psi
        return HalfDifference(theta_h, np.minimum(self.theta_d, np.maximum(flattest, 0)), self.phi_d)

    def pairs(self) -> Pairs:
        """Return the directions, which lie about the x axis."""
        cos_h, sin_h = np.cos(self.theta_h), np.sin(self.theta_h)
        nothing = np.zeros_like(cos_h)
        h = np.stack([sin_h, nothing, cos_h], axis=-1)
        t = np.stack([cos_h, nothing, -sin_h], axis=-1)
        turned = np.cos(self.phi_d)[:, None] * t + np.sin(self.phi_d)[:, None] * np.array([0.0, 1.0, 0.0])
        middle, side = np.cos(self.theta_d)[:, None] * h, np.sin(self.theta_d)[:, None] * turned
        return Pairs(np.zeros(cos_h.size, np.int32), middle + side, middle - side)


def lower_cosine(
    theta_h: NDArray[np.floating], theta_d: NDArray[np.floating], cos_phi_d: NDArray[np.floating]
) -> FloatArray:
    """Return the cosine to the normal of the lower of both directions."""
    return np.asarray(np.cos(theta_h) * np.cos(theta_d) - np.sin(theta_h) * np.sin(theta_d) * abs(cos_phi_d))


def half_difference_of(pairs: Pairs) -> HalfDifference:
    """Return the angles of pairs of directions above the surface, phi_d from -pi to pi."""
    h = pairs.incoming + pairs.outgoing
    h = h / np.linalg.norm(h, axis=-1, keepdims=True)
    across = np.hypot(h[:, 0], h[:, 1])
    turned = np.maximum(across, np.finfo(float).tiny)
    cos_turn, sin_turn = np.where(across > 0, h[:, 0] / turned, 1.0), h[:, 1] / turned
    x = pairs.incoming[:, 0] * cos_turn + pairs.incoming[:, 1] * sin_turn
    b = pairs.incoming[:, 1] * cos_turn - pairs.incoming[:, 0] * sin_turn
    t = x * h[:, 2] - pairs.incoming[:, 2] * across
    along = np.sum(pairs.incoming * h, axis=-1)
    return HalfDifference(np.arctan2(across, h[:, 2]), np.arctan2(np.hypot(t, b), along), np.arctan2(b, t))
