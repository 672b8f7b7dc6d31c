"""Grids that keep a promise: as few texels as hold ``[accuracy] delta_e``."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.tables.axes import MAX_POINTS
from nacreous.tables.certificate import Cells, Colouring, colour_cells, colour_differences
from nacreous.tables.film import Grid
from nacreous.tables.solver import FilmSolver

__all__ = ["refined"]

FloatArray = NDArray[np.float64]

_SHARES = (0.2, 0.35, 0.5, 0.65, 0.8)
"""Parts of the allowed difference that the angle axis may use up; the thickness axis has the rest."""
_WIDEN = 1.05
"""Growth of both axes while the two errors together still exceed what each was allowed."""
_PROBE_SCALES, _PROBE_ANGLES, _PROBED_CELLS = 9, 33, 512


def refined(solver: FilmSolver, grid: Grid, colouring: Colouring, delta_e: float) -> Grid:
    """Return the grid with as many angles and thickness scales as `delta_e` needs, the spec's own at least.

    The two axes' errors are measured apart, the share of each is varied, and the smallest table among them is
    widened until the whole of it holds. A refined axis is spaced as the spec's is.

    Raises
    ------
    SpecError
        No grid of at most 65,536 points an axis is fine enough.
    """

    angles, scales = min(
        (_counts(solver, grid, colouring, delta_e, share) for share in _shares(grid)),
        key=lambda counts: counts[0] * counts[1],
    )
    while not _holds(solver, _respaced(grid, angles, scales), colouring, delta_e):
        angles, scales = _widened(angles), _widened(scales)
    return _respaced(grid, angles, scales)


def _holds(solver: FilmSolver, grid: Grid, colouring: Colouring, delta_e: float) -> bool:
    return bool(colour_differences(solver, *colour_cells(grid), colouring).max() <= delta_e)


def _shares(grid: Grid) -> tuple[float, ...]:
    return (1.0,) if grid.thickness_scale.size == 1 else _SHARES


def _counts(
    solver: FilmSolver, grid: Grid, colouring: Colouring, delta_e: float, share: float
) -> tuple[int, int]:
    """Angles and scales that keep their shares of `delta_e`, each with the other axis at a few of its values."""

    def angle_error(angles: int) -> float:
        cells = Cells.along(_spaced(grid.cos_theta, angles), _PROBED_CELLS)
        points = _points(grid.thickness_scale, _PROBE_SCALES)
        return float(colour_differences(solver, points, cells, colouring).max())

    def scale_error(scales: int) -> float:
        cells = Cells.along(_spaced(grid.thickness_scale, scales), _PROBED_CELLS)
        points = _points(grid.cos_theta, _PROBE_ANGLES)
        return float(colour_differences(solver, cells, points, colouring).max())

    angles = _fewest(angle_error, grid.cos_theta.size, share * delta_e)
    if grid.thickness_scale.size == 1:
        return angles, 1
    return angles, _fewest(scale_error, grid.thickness_scale.size, (1 - share) * delta_e)


def _fewest(error: Callable[[int], float], least: int, allowed: float) -> int:
    """Smallest count from `least` on whose error is allowed: doubled until it is, then halved in."""
    if error(least) <= allowed:
        return least
    low, high = least, 2 * least
    while error(high) > allowed:
        low, high = high, 2 * high
        if high > MAX_POINTS:
            raise _unreachable(allowed)
    while high - low > max(1, low // 64):
        middle = (low + high) // 2
        low, high = (low, middle) if error(middle) <= allowed else (middle, high)
    return high


def _widened(count: int) -> int:
    if count == 1:
        return 1
    wider = int(np.ceil(count * _WIDEN))
    if wider > MAX_POINTS:
        raise _unreachable(0)
    return wider


def _points(axis: FloatArray, most: int) -> Cells:
    values = _spaced(axis, min(most, axis.size))
    return Cells(values, values)


def _spaced(axis: FloatArray, count: int) -> FloatArray:
    """`count` values from the axis's first to its last, spaced as its own are."""
    return np.interp(np.linspace(0, axis.size - 1, count), np.arange(axis.size), axis)


def _respaced(grid: Grid, angles: int, scales: int) -> Grid:
    return replace(
        grid, cos_theta=_spaced(grid.cos_theta, angles), thickness_scale=_spaced(grid.thickness_scale, scales)
    )


def _unreachable(allowed: float) -> SpecError:
    got = f"{allowed:.2g} or less for one axis" if allowed else "less"
    remedy = "allow a larger difference, or tabulate a smaller range of angles or thicknesses"
    return SpecError("accuracy.delta_e", f"a difference that {MAX_POINTS:,} points an axis can keep", got, remedy)
