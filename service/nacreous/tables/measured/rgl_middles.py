"""What lines between the samples of a measured material are off by, taken off the samples.

A line between two samples of a curve is off by h^2 f'' / 8 in the middle and by two thirds of that on
average, to the same side. Samples moved by these two thirds leave it nothing on average, and at most two
thirds anywhere. Errors along several axes add up in the middle of a cell, so that one look there is enough
for all of them: both axes of the square and both angles of the incoming light. Errors are relative, so that
faint directions count as much as bright ones.

Wavelengths and light along the normal are left alone: both are looked at by themselves, in a furnace say,
and are exact where the file has them.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.precision import Precision
from nacreous.opencl.warp import warped
from nacreous.optics.square_density import SquareDensities
from nacreous.tables.bsdf.solver import BsdfSolver
from nacreous.tables.measured.rgl_grid import RglGrid, square_points, unit_vectors
from nacreous.tables.measured.rgl_table import RglTable, jacobian
from nacreous.tables.measured.rgl_warp import reflected_f_cos, reflected_pairs
from nacreous.tables.measured.surface import Shades

__all__ = ["without_bias"]

FloatArray = NDArray[np.float64]

_MOST_ERROR = 1.0
"""Relative error beyond which more is not taken off: beside the horizon a line is many times too bright."""


def without_bias(solver: BsdfSolver, shades: Shades, table: RglTable) -> RglTable:
    """Return a table whose samples are moved by two thirds of the mean error of the cells about them."""
    grid = table.grid
    shape = (grid.azimuths, grid.tilts, grid.samples, grid.samples)
    values = table.values.reshape(*shape, -1)
    moved, cells = np.zeros(values.shape), np.zeros((*shape, 1))
    for tilt in range(grid.tilts - 1):
        error, seen = _errors(solver, shades, table, tilt)
        for node in (tilt, tilt + 1):
            moved[:, node] += error
            cells[:, node] += seen
    moved[:, 0] = 0  # along the normal
    moved *= -2 / 3 / np.maximum(cells, 1)
    moved += 1
    moved *= values
    return replace(table, values=moved.reshape(table.values.shape))


def _errors(solver: BsdfSolver, shades: Shades, table: RglTable, tilt: int) -> tuple[FloatArray, FloatArray]:
    """Sum the relative errors in the middles of the cells above a tilt about each sample, (Q, N, N, C).

    The second array, (Q, N, N, 1), counts the cells whose middle reflects above the horizon.
    """
    grid = table.grid
    incoming, densities = _between(grid, table.densities, tilt)
    middles = square_points((np.arange(grid.samples - 1) + 0.5) / (grid.samples - 1))
    places = np.asarray(warped(solver.albedo.device, densities, middles, Precision.DOUBLE), np.float64)
    pairs, above = reflected_pairs(incoming, places)
    truth = reflected_f_cos(solver, shades, pairs, above)
    values = table.values.reshape(grid.azimuths, grid.tilts, grid.samples, grid.samples, -1)
    corners = _middles(_middles(_around(grid, values[:, tilt : tilt + 2].mean(axis=1)), 1), 2)
    x, y = places.reshape(-1, 2).T
    read = corners.reshape(truth.shape) * jacobian(table.ndf, table.sigma, pairs.incoming, x, y)[:, None]
    error = np.divide(read, truth, out=np.ones(truth.shape), where=truth > 0) - 1
    error = np.clip(error, -_MOST_ERROR, _MOST_ERROR).reshape(corners.shape)
    seen = above.astype(np.float64).reshape(*corners.shape[:-1], 1)
    return _summed(grid, error), _summed(grid, seen)


def _between(grid: RglGrid, densities: SquareDensities, tilt: int) -> tuple[FloatArray, SquareDensities]:
    """Return the light in the middle between slices, (S', 3), and what a reader warps by there."""
    theta = grid.theta_i[tilt : tilt + 2].mean()
    phi = _around(grid, grid.phi_i)
    stored = densities.density.reshape(grid.azimuths, grid.tilts, *densities.density.shape[1:])
    mean = _around(grid, stored[:, tilt : tilt + 2].mean(axis=1))
    return unit_vectors(np.full(phi.shape, theta), phi), SquareDensities.of(mean)


def _around(grid: RglGrid, values: FloatArray) -> FloatArray:
    """Return values (Q, …) in the middle between azimuths, or as they are where there is one."""
    return values if grid.isotropic else _middles(values, 0)


def _middles(values: FloatArray, axis: int) -> FloatArray:
    """Return the means of neighbours along an axis."""
    last = values.shape[axis] - 1
    return np.asarray((np.take(values, range(last), axis) + np.take(values, range(1, last + 1), axis)) / 2)


def _summed(grid: RglGrid, cells: FloatArray) -> FloatArray:
    """Sum cells (Q', N - 1, N - 1, C) about each sample, (Q, N, N, C); azimuths of light go all around."""
    padded = np.pad(cells, ((0, 0), (1, 1), (1, 1), (0, 0)))
    if not grid.isotropic:
        padded = 2 * _middles(np.pad(padded, ((1, 1), (0, 0), (0, 0), (0, 0)), mode="wrap"), 0)
    return 4 * _middles(_middles(padded, 1), 2)
