"""The directions of a BSDF table: every combination of its angles, as pairs of unit vectors."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.bsdf import Pairs
from nacreous.opencl.film_colour import Side

__all__ = ["DirectionGrid"]

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class DirectionGrid:
    """Angles in radians, and the roughnesses that they are taken at.

    Parameters
    ----------
    roughness : int array, shape (R,)
        Places on the solver's axis.
    phi_i, theta_i, theta_o, phi : float arrays, shape (Q,), (I,), (O,) and (P,)
        Azimuth of the incoming light, polar angles from the normal, or for transmitted light from its
        opposite, and the azimuth of the outgoing light from that of the incoming.
    """

    roughness: NDArray[np.int32]
    phi_i: FloatArray
    theta_i: FloatArray
    theta_o: FloatArray
    phi: FloatArray

    @property
    def shape(self) -> tuple[int, int, int, int, int]:
        """Samples of each axis: (R, Q, I, O, P)."""
        axes = (self.roughness, self.phi_i, self.theta_i, self.theta_o, self.phi)
        r, q, i, o, p = (axis.size for axis in axes)
        return r, q, i, o, p

    def pairs(self, side: Side) -> Pairs:
        """Every combination in the order of `shape`, the last axis fastest."""
        places = np.indices(self.shape).reshape(5, -1)
        phi_i, theta_i = self.phi_i[places[1]], self.theta_i[places[2]]
        theta_o, phi = self.theta_o[places[3]], self.phi[places[4]]
        outgoing = _unit_vectors(theta_o, phi_i + phi)
        if side is Side.TRANSMISSION:
            outgoing[:, 2] *= -1
        return Pairs(self.roughness[places[0]], _unit_vectors(theta_i, phi_i), outgoing)


def _unit_vectors(theta: FloatArray, phi: FloatArray) -> FloatArray:
    sine = np.sin(theta)
    return np.stack([sine * np.cos(phi), sine * np.sin(phi), np.cos(theta)], axis=-1)
