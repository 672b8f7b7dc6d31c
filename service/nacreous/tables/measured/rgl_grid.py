"""The grid of a table in the parametrisation of Dupuy and Jakob 2018, and its maps to directions.

Polar angles lie on the unit interval as theta = u^2 pi / 2 and azimuths as phi = (2 u - 1) pi, so that both a
narrow lobe and the horizon have room. An isotropic surface counts the azimuth of a facet from that of the
incoming light.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nacreous.tables.axes import MAX_COUNTED_THETA

__all__ = [
    "LADDERS",
    "RglGrid",
    "phi_of",
    "square_points",
    "theta_of",
    "unit_of_phi",
    "unit_of_theta",
    "unit_vectors",
]

FloatArray = NDArray[np.float64]

_GRAZING = 0.85
"""Exponent of the spacing of theta_i: below 1 nodes are dense at flat angles, where most changes."""


@dataclass(frozen=True)
class RglGrid:
    """How many samples a table takes.

    Parameters
    ----------
    azimuths, tilts : int
        Of the incoming light, Q and I; Q = 1 for an isotropic surface. There are S = Q I slices.
    samples : int
        Along each side of the warped square, N.
    rows, columns : int
        Of the density that the square is warped by: azimuths and tilts of a facet, H and W.
    facet_azimuths, facet_tilts : int
        Of the distribution of facets and its projected areas, G and K.
    """

    azimuths: int
    tilts: int
    samples: int
    rows: int
    columns: int
    facet_azimuths: int
    facet_tilts: int

    @property
    def isotropic(self) -> bool:
        """Whether the surface looks the same from any azimuth."""
        return self.azimuths == 1

    @property
    def phi_i(self) -> FloatArray:
        """Azimuths of the incoming light in radians, (Q,): all around, because pbrt-v4 reads no less."""
        return np.zeros(1) if self.isotropic else np.linspace(-math.pi, math.pi, self.azimuths)

    @property
    def theta_i(self) -> FloatArray:
        """Angles of the incoming light from the normal in radians, (I,)."""
        return np.asarray(MAX_COUNTED_THETA * np.linspace(0, 1, self.tilts) ** _GRAZING)

    @property
    def incoming(self) -> FloatArray:
        """Direction of each slice, (S, 3), phi_i before theta_i."""
        phi, theta = np.meshgrid(self.phi_i, self.theta_i, indexing="ij")
        return unit_vectors(theta.ravel(), phi.ravel())

    def numbers(self, channels: int) -> int:
        """Numbers that a file of so many wavelengths or colours stores."""
        slices = self.azimuths * self.tilts
        facets = 2 * self.facet_azimuths * self.facet_tilts
        return slices * (self.rows * self.columns + (channels + 1) * self.samples**2) + facets


_ISOTROPIC = {"rows": 64, "columns": 128, "facet_azimuths": 2, "facet_tilts": 2048}
_ANISOTROPIC = {"rows": 48, "columns": 64, "facet_azimuths": 256, "facet_tilts": 512}

LADDERS: dict[bool, tuple[RglGrid, ...]] = {
    False: tuple(
        RglGrid(1, tilts, samples, **_ISOTROPIC)
        for tilts, samples in ((24, 24), (32, 32), (28, 38), (28, 44), (36, 48), (48, 48))
    ),
    True: tuple(
        RglGrid(azimuths, tilts, samples, **_ANISOTROPIC)
        for azimuths, tilts, samples in ((17, 16, 14), (21, 17, 17), (25, 20, 20), (25, 20, 24), (33, 24, 32))
    ),
}
"""Grids to choose from, small ones first, for isotropic (False) and anisotropic (True) surfaces."""


def square_points(places: FloatArray) -> FloatArray:
    """Return the points of the square with these places on either side, (N^2, 2), x fastest."""
    x, y = np.meshgrid(places, places)
    return np.stack([x.ravel(), y.ravel()], axis=-1)


def theta_of(u: FloatArray) -> FloatArray:
    """Polar angle in radians at a place of the unit interval."""
    return u**2 * (math.pi / 2)


def phi_of(u: FloatArray) -> FloatArray:
    """Azimuth in radians at a place of the unit interval."""
    return (2 * u - 1) * math.pi


def unit_of_theta(theta: FloatArray) -> FloatArray:
    """Return the inverse of `theta_of`."""
    return np.sqrt(theta * (2 / math.pi))


def unit_of_phi(phi: FloatArray) -> FloatArray:
    """Return the inverse of `phi_of`, for any phi."""
    u = (phi + math.pi) / (2 * math.pi)
    return np.asarray(u - np.floor(u))


def unit_vectors(theta: FloatArray, phi: FloatArray) -> FloatArray:
    """Return unit vectors (…, 3) of polar angles and azimuths (…)."""
    sine = np.sin(theta)
    return np.stack([sine * np.cos(phi), sine * np.sin(phi), np.cos(theta)], axis=-1)
