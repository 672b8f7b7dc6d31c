"""A table in the parametrisation of Dupuy and Jakob 2018: what is stored, and what a reader makes of it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.bsdf import Pairs
from nacreous.optics.square_density import SquareDensities, bilinear
from nacreous.tables.measured.multilinear import interval
from nacreous.tables.measured.rgl_grid import RglGrid, unit_of_phi, unit_of_theta
from nacreous.tables.table import Variable

__all__ = ["RglTable", "angles_of", "jacobian", "looked_up"]

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class RglTable:
    """What a file holds, and how a reader evaluates it.

    Parameters
    ----------
    grid : RglGrid
    ndf, sigma : float arrays, shape (G, K)
        Distribution of facets in 1 / sr, and their projected area, over azimuth and tilt.
    densities : SquareDensities
        S densities of H rows and W columns.
    luminance : float array, shape (S, N, N)
    values : float array, shape (S, N, N, C)
    """

    grid: RglGrid
    ndf: FloatArray
    sigma: FloatArray
    densities: SquareDensities
    luminance: FloatArray
    values: FloatArray

    def evaluate(self, pairs: Pairs) -> FloatArray:
        """Return f cos_o at pairs of directions as a reader has it, (P, C)."""
        m = pairs.incoming + pairs.outgoing
        m = m / np.linalg.norm(m, axis=-1, keepdims=True)
        theta_i, phi_i = angles_of(pairs.incoming)
        theta_m, phi_m = angles_of(m)
        x, y = unit_of_theta(theta_m), unit_of_phi(phi_m - phi_i if self.grid.isotropic else phi_m)
        slices, weights = _slices(self.grid, theta_i, phi_i)
        s = self.densities.inverse(x, y, slices, weights)
        values = bilinear(self.values, *s, slices, weights)
        return np.asarray(values * jacobian(self.ndf, self.sigma, pairs.incoming, x, y)[:, None])

    def variables(self, name: str, channel: str) -> dict[str, Variable]:
        """Return the arrays of a file, in the order of their axes there."""
        slices = (self.grid.azimuths, self.grid.tilts)
        incoming = ("phi_i", "theta_i")
        stored = np.moveaxis(self.values, -1, 1).reshape(*slices, -1, *self.luminance.shape[1:])
        densities = self.densities.density.reshape(*slices, *self.densities.density.shape[1:])
        luminance = self.luminance.reshape(*slices, *self.luminance.shape[1:])
        facets, square = ("phi_m", "theta_m"), ("v", "u")
        return {
            "ndf": Variable(facets, _single(self.ndf), "1/sr", "distribution of facets"),
            "sigma": Variable(facets, _single(self.sigma), "1", "projected area of facets"),
            "vndf": Variable((*incoming, "row", "column"), _single(densities), "1", "density of the warp"),
            "luminance": Variable((*incoming, *square), _single(luminance), "1", "what is sampled first"),
            name: Variable((*incoming, channel, *square), _single(stored), "1", "f cos_o 4 sigma / ndf"),
        }


def angles_of(directions: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return polar angle and azimuth in radians of unit vectors (P, 3), exact at the normal."""
    x, y, z = directions.T
    return np.arctan2(np.hypot(x, y), z), np.arctan2(y, x)


def _slices(grid: RglGrid, theta: FloatArray, phi: FloatArray) -> tuple[NDArray[np.int_], FloatArray]:
    """Return the slices about incoming directions, (P, 2) or (P, 4), and their weights."""
    lower, upper_share = interval(grid.theta_i, theta)
    tilts = ((lower, 1 - upper_share), (lower + 1, upper_share))
    if grid.isotropic:
        around = [(np.zeros_like(lower), np.ones_like(theta))]
    else:
        first, share = interval(grid.phi_i, phi)
        around = [(first, 1 - share), (first + 1, share)]
    corners = [(q * grid.tilts + i, a * b) for q, a in around for i, b in tilts]
    return np.stack([c[0] for c in corners], -1), np.stack([c[1] for c in corners], -1)


def jacobian(
    ndf: FloatArray, sigma: FloatArray, incoming: FloatArray, x: FloatArray, y: FloatArray
) -> FloatArray:
    """Return ndf / (4 sigma) as a reader has it, for light (P, 3) and facets at points of the square (P,)."""
    theta, phi = angles_of(incoming)
    return looked_up(ndf, x, y) / (4 * looked_up(sigma, unit_of_theta(theta), unit_of_phi(phi)))


def looked_up(table: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    """Return bilinear values of one table, (H, W), at points of the square, (P,)."""
    one = np.zeros((x.size, 1), np.int_)
    return bilinear(table[None, ..., None], x, y, one, np.ones((x.size, 1)))[:, 0]


def _single(values: FloatArray) -> NDArray[np.float32]:
    return np.ascontiguousarray(values, np.float32)
