"""One spec's film, ready to be evaluated at any points: what tables and certificates are computed with."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side, film_colours
from nacreous.opencl.film_ellipsometry import film_ellipsometry
from nacreous.opencl.film_problem import FilmProblem
from nacreous.opencl.precision import Precision
from nacreous.opencl.tiles import Observer
from nacreous.optics.stack import SampledStack, Stack, sample_stack
from nacreous.tables.film import Grid, checked_intensities, film_problem, phase_precision, problem_of
from nacreous.tables.thickness_spread import ThicknessSpread, converged_spread, one_thickness

__all__ = ["FilmSolver", "film_solver", "probe", "probe_of"]

FloatArray = NDArray[np.float64]

TRANSMITTING_K = 1e-3
"""A substrate with less than this k lets light through; more, and a millimetre of it is opaque."""

_SPREAD_PROBES = (2, 8, 48)
"""Scales, angles and wavelengths at which the nodes of a thickness spread are settled."""


@dataclass(frozen=True, eq=False)
class FilmSolver:
    """A film on a device.

    Parameters
    ----------
    device : Device
    stack : Stack
    spread : ThicknessSpread
        Nodes of the thickness distribution.
    precision : Precision
        Of the tables; `exact` results are always in double precision.
    transmits : bool
        Whether the substrate lets light through.
    """

    device: Device
    stack: Stack
    spread: ThicknessSpread
    precision: Precision
    transmits: bool
    _sampled: dict[bytes, SampledStack] = field(init=False, repr=False, default_factory=dict)

    @property
    def sides(self) -> tuple[Side, ...]:
        """Reflection, and transmission where there is any."""
        return (Side.REFLECTION, Side.TRANSMISSION) if self.transmits else (Side.REFLECTION,)

    def intensities(self, grid: Grid, observer: Observer | None = None) -> dict[str, NDArray[np.floating]]:
        """R_s, R_p, T_s and T_p of shape (S, A, L), in the table's precision."""
        problem = self._problem(grid)
        return checked_intensities(self.device, problem, self.precision, observer)

    def exact_intensities(self, grid: Grid) -> dict[str, NDArray[np.floating]]:
        """R_s, R_p, T_s and T_p of shape (S, A, L), in double precision."""
        problem = self._problem(grid)
        return checked_intensities(self.device, problem, Precision.DOUBLE)

    def ellipsometry(self, grid: Grid, observer: Observer | None = None) -> dict[str, NDArray[np.floating]]:
        """Ellipsometric psi and Delta of shape (S, A, L), in radians."""
        problem = self._problem(grid)
        return film_ellipsometry(self.device, problem, self.precision, observer=observer)

    def colours(
        self, grid: Grid, weights: FloatArray, sides: tuple[Side, ...], observer: Observer | None = None
    ) -> NDArray[np.floating]:
        """Linear colours of R, T or both, (sides, S, A, 3), the grid's wavelengths weighted with (3, L)."""
        problem = self._problem(grid)
        return film_colours(self.device, problem, weights, sides, self.precision, observer=observer)

    def exact_colours(self, grid: Grid, weights: FloatArray, sides: tuple[Side, ...]) -> FloatArray:
        """Return the same in double precision."""
        problem = self._problem(grid)
        return np.asarray(film_colours(self.device, problem, weights, sides, Precision.DOUBLE))

    def _problem(self, grid: Grid) -> FilmProblem:
        """Lay the film out; the materials are sampled once for each set of wavelengths."""
        wavelengths = grid.wavelength_nm.tobytes()
        if wavelengths not in self._sampled:
            self._sampled[wavelengths] = sample_stack(self.stack, grid.wavelength_nm)
        return problem_of(self._sampled[wavelengths], self.spread, grid)


def film_solver(device: Device, stack: Stack, grid: Grid, asked: Precision) -> FilmSolver:
    """Settle the thickness nodes and the precision that the film needs on a grid."""
    transmits = bool(sample_stack(stack, grid.wavelength_nm).index[-1].imag.max() < TRANSMITTING_K)
    spread = _spread(device, stack, grid)
    precision = phase_precision(film_problem(stack, spread, grid), asked)
    return FilmSolver(device, stack, spread, precision, transmits)


def _spread(device: Device, stack: Stack, grid: Grid) -> ThicknessSpread:
    sampled = sample_stack(stack, grid.wavelength_nm[:1])
    if not sampled.thickness_sigma_nm.any():
        return one_thickness(sampled.thickness_nm.size)
    few = probe_of(grid, _SPREAD_PROBES)

    def mean_intensities(spread: ThicknessSpread) -> FloatArray:
        problem = film_problem(stack, spread, few)
        computed = checked_intensities(device, problem, Precision.DOUBLE)
        return np.stack([np.asarray(values, np.float64) for values in computed.values()])

    return converged_spread(stack, grid.wavelength_nm, mean_intensities)


def probe_of(grid: Grid, counts: tuple[int, int, int]) -> Grid:
    """Return at most so many scales, angles and wavelengths of a grid, evenly spread, the ends among them."""
    axes = (grid.thickness_scale, grid.cos_theta, grid.wavelength_nm)
    return Grid(*(probe(axis, count) for axis, count in zip(axes, counts, strict=True)))


def probe(axis: FloatArray, count: int) -> FloatArray:
    """Return at most `count` values of an axis, evenly spread, both ends among them."""
    values: FloatArray = axis[np.unique(np.linspace(0, axis.size - 1, count).round().astype(int))]
    return values
