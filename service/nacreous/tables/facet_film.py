"""The film that facets carry: R and T at nodes close enough for a cubic to stand between them.

A facet sees light at the angle theta_d between it and the ray, and the film depends on nothing else. So a
rough surface needs the film at cosines equally spaced over [0, 1], the nodes, once for all directions;
kernels/nodes.clh interpolates between them.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.precision import Precision
from nacreous.optics.quadrature import gauss_legendre
from nacreous.optics.stack import Stack, sample_stack
from nacreous.tables.film import SINGLE_TOLERANCE, Grid
from nacreous.tables.solver import FilmSolver, film_solver, probe_of

__all__ = ["FacetFilm", "cosine_weighted_nodes", "facet_film", "on_facets"]

FloatArray = NDArray[np.float64]

SETTLED = 1e-5
"""Error of R and T between the nodes at which they are close enough."""
_FEWEST, _MOST = 65, 4097
_PROBE_SCALES, _PROBE_WAVELENGTHS = 3, 64
_MEAN_NODES = 64

_COSINES = np.linspace(0.0, 1.0, 65)
"""Cosines over all of the angles to a facet, for what a film needs on a grid."""


@dataclass(frozen=True, eq=False)
class FacetFilm:
    """A film at nodes over the cosine at the facet.

    Parameters
    ----------
    solver : FilmSolver
    nodes : int
        Cosines, equally spaced over [0, 1].
    error : float
        Largest difference of R and T between the nodes from the cubic through them, at probes.
    """

    solver: FilmSolver
    nodes: int
    error: float

    @property
    def cosines(self) -> FloatArray:
        """Cosines of the nodes, shape (K,)."""
        return np.linspace(0.0, 1.0, self.nodes)

    def finer(self) -> "FacetFilm":
        """Return the film in double precision at twice as many nodes: what errors are measured against."""
        return FacetFilm(replace(self.solver, precision=Precision.DOUBLE), 2 * self.nodes - 1, self.error)

    def opaque(self) -> "FacetFilm":
        """Return the film without what it transmits, which is lost."""
        return replace(self, solver=replace(self.solver, transmits=False))

    def spectra(self, thickness_scale: FloatArray, wavelength_nm: FloatArray) -> dict[Side, FloatArray]:
        """Unpolarised R and T at the nodes, shape (S, K, L) each."""
        return _unpolarised(self.solver, Grid(thickness_scale, self.cosines, wavelength_nm))

    def colours(
        self, thickness_scale: FloatArray, wavelength_nm: FloatArray, weights: FloatArray, side: Side
    ) -> FloatArray:
        """Linear colour of R or T at the nodes, (S, K, 3), the wavelengths weighted with (3, L)."""
        grid = Grid(thickness_scale, self.cosines, wavelength_nm)
        return np.asarray(self.solver.colours(grid, weights, (side,))[0], np.float64)

    def mean_reflectance(self, thickness_scale: FloatArray, wavelength_nm: FloatArray) -> FloatArray:
        """Cosine-weighted mean of R over the hemisphere, 2 integral of R mu d mu, shape (S, L)."""
        mu, weights = cosine_weighted_nodes(_MEAN_NODES)
        R = _unpolarised(self.solver, Grid(thickness_scale, mu, wavelength_nm))[Side.REFLECTION]
        return np.asarray(np.einsum("sal,a->sl", R, weights))

    def indices(self, wavelength_nm: FloatArray) -> FloatArray:
        """Real index of the incident medium and of the substrate, shape (2, L)."""
        return sample_stack(self.solver.stack, wavelength_nm).index[[0, -1]].real


def cosine_weighted_nodes(count: int) -> tuple[FloatArray, FloatArray]:
    """Cosines and weights, (N,) each, for the mean 2 integral of g(mu) mu d mu: Gauss-Legendre in mu^2."""
    squared, weights = gauss_legendre(count)
    return np.sqrt(squared), weights


def on_facets(grid: Grid) -> Grid:
    """Return a table's grid with the angles that facets of any tilt see the light at."""
    return replace(grid, cos_theta=_COSINES)


def facet_film(device: Device, stack: Stack, grid: Grid, asked: Precision) -> FacetFilm:
    """Settle how many nodes a film needs, and take double precision where rounding exceeds 2e-5.

    A film between media of the same index, or one with a critical angle, has a kink that no cubic follows:
    the error of the nodes is then what is left at 4,097 of them.
    """
    solver = film_solver(device, stack, on_facets(grid), asked)
    probe = probe_of(grid, (_PROBE_SCALES, 1, _PROBE_WAVELENGTHS))
    exact = replace(solver, precision=Precision.DOUBLE)
    nodes, values = _FEWEST, _both(exact, probe, _FEWEST)
    while True:
        finer = _both(exact, probe, 2 * nodes - 1)
        error = float(np.abs(finer[:, :, 1::2] - _cubic_middles(values)).max())
        if error <= SETTLED or nodes == _MOST:
            break
        nodes, values = 2 * nodes - 1, finer
    rounding = np.abs(_both(solver, probe, nodes) - values).max() if solver is not exact else 0.0
    return FacetFilm(exact if rounding > SINGLE_TOLERANCE else solver, nodes, error)


def _both(solver: FilmSolver, probe: Grid, nodes: int) -> FloatArray:
    """R and T at so many nodes of a probe's scales and wavelengths: (2, S, K, L)."""
    sides = _unpolarised(solver, replace(probe, cos_theta=np.linspace(0.0, 1.0, nodes)))
    return np.stack(list(sides.values()))


def _unpolarised(solver: FilmSolver, grid: Grid) -> dict[Side, FloatArray]:
    got = {name: np.asarray(values, np.float64) for name, values in solver.intensities(grid).items()}
    return {
        Side.REFLECTION: (got["R_s"] + got["R_p"]) / 2,
        Side.TRANSMISSION: (got["T_s"] + got["T_p"]) / 2,
    }


def _cubic_middles(values: FloatArray) -> FloatArray:
    """Values between neighbours along axis 2, as kernels/nodes.clh interpolates them."""
    inner = (9 * (values[:, :, 1:-2] + values[:, :, 2:-1]) - values[:, :, :-3] - values[:, :, 3:]) / 16
    ends = values[:, :, :4], values[:, :, :-5:-1]
    first, last = (np.einsum("k,dskl->dsl", [5 / 16, 15 / 16, -5 / 16, 1 / 16], four) for four in ends)
    return np.concatenate([first[:, :, None], inner, last[:, :, None]], axis=2)
