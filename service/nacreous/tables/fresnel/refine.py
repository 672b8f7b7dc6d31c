"""Grids that keep a promise: as few texels as hold ``[accuracy] delta_e``."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.tables.axes import MAX_POINTS
from nacreous.tables.cells import Cells
from nacreous.tables.colour import Colouring
from nacreous.tables.film import Grid
from nacreous.tables.fresnel.certificate import (
    all_colour_cells,
    colour_cells,
    colour_differences,
    short_of_grazing,
)
from nacreous.tables.solver import FilmSolver

__all__ = ["fewest", "refined", "spaced", "unreachable"]

FloatArray = NDArray[np.float64]

_ALMOST = 0.95
"""Part of the allowed difference that the thickness axis may use up, so that some is left for the angles."""
_WIDEN, _HELPED = (1.02, 1.3), 0.9
"""Least and largest growth of a count while a cell does not hold, and what part of it counts as less."""
_PROBE_ANGLES, _PROBED_CELLS = 17, 256
"""Angles, and cells along the thickness axis, at which its error is measured by itself."""
_GROWTHS = (1.0, 1.15, 1.4, 1.8, 2.5, 4.0)
"""Factors on the thickness scales that hold by themselves; more scales leave more error to the angles."""


def refined(solver: FilmSolver, grid: Grid, colouring: Colouring, delta_e: float) -> Grid:
    """Return the grid with as many angles and thickness scales as `delta_e` needs, the spec's own at least.

    For several numbers of thickness scales, the fewest angles are sought with which the whole table holds;
    the smallest table of these wins. A refined axis is spaced as the spec's is.

    Raises
    ------
    SpecError
        No grid of at most 65,536 points an axis is fine enough.
    """

    def fewest_angles(scales: int) -> int | None:
        def error(angles: int) -> float:
            cells = colour_cells(_respaced(grid, angles, scales), colouring)
            return float(colour_differences(solver, *cells, colouring).max())

        return fewest(error, grid.cos_theta.size, delta_e)

    best: tuple[int, int] | None = None
    for scales in _scale_counts(solver, grid, colouring, delta_e):
        angles = fewest_angles(scales)
        if best is not None and (angles is None or angles * scales >= best[0] * best[1]):
            break
        best = best if angles is None else (angles, scales)
    if best is None:
        raise unreachable(delta_e)
    return _holding_everywhere(solver, grid, colouring, delta_e, *best)


def _holding_everywhere(
    solver: FilmSolver, grid: Grid, colouring: Colouring, delta_e: float, angles: int, scales: int
) -> Grid:
    """Widen a table that holds at the cells tried until it holds at all of them, the angles first."""

    def worst(angles: int, scales: int) -> float:
        cells = all_colour_cells(_respaced(grid, angles, scales))
        return float(colour_differences(solver, *cells, colouring).max())

    error = worst(angles, scales)
    while error > delta_e:
        growth = float(np.clip((error / delta_e) ** 0.5, *_WIDEN))
        angles, before = math.ceil(growth * angles), error
        error = worst(angles, scales)
        if error > delta_e and error > _HELPED * before and scales > 1:
            scales = math.ceil(growth * scales)
            error = worst(angles, scales)
        if max(angles, scales) > MAX_POINTS:
            raise unreachable(delta_e)
    return _respaced(grid, angles, scales)


def _scale_counts(solver: FilmSolver, grid: Grid, colouring: Colouring, delta_e: float) -> tuple[int, ...]:
    """Numbers of thickness scales worth trying: from those that hold at a few angles, upwards."""
    if grid.thickness_scale.size == 1:
        return (1,)
    values = spaced(grid.cos_theta, min(_PROBE_ANGLES, grid.cos_theta.size))
    angles = short_of_grazing(Cells(values, values))

    def error(scales: int) -> float:
        cells = Cells.along(spaced(grid.thickness_scale, scales), _PROBED_CELLS)
        return float(colour_differences(solver, cells, angles, colouring).max())

    alone = fewest(error, grid.thickness_scale.size, _ALMOST * delta_e)
    if alone is None:
        raise unreachable(delta_e)
    return tuple(count for growth in _GROWTHS if (count := round(alone * growth)) <= MAX_POINTS)


def fewest(error: Callable[[int], float], least: int, allowed: float) -> int | None:
    """Return the smallest count from `least` on whose error is allowed: doubled, then halved in; or None."""
    if error(least) <= allowed:
        return least
    low, high = least, 2 * least
    while error(high) > allowed:
        low, high = high, 2 * high
        if high > MAX_POINTS:
            return None
    while high - low > max(1, low // 32):
        middle = (low + high) // 2
        low, high = (low, middle) if error(middle) <= allowed else (middle, high)
    return high


def spaced(axis: FloatArray, count: int) -> FloatArray:
    """Return `count` values from the axis's first to its last, spaced as its own are."""
    return np.interp(np.linspace(0, axis.size - 1, count), np.arange(axis.size), axis)


def _respaced(grid: Grid, angles: int, scales: int) -> Grid:
    return replace(
        grid, cos_theta=spaced(grid.cos_theta, angles), thickness_scale=spaced(grid.thickness_scale, scales)
    )


def unreachable(allowed: float) -> SpecError:
    """Return the refusal of a difference that no grid can keep."""
    return SpecError(
        "accuracy.delta_e",
        f"a difference that {MAX_POINTS:,} points an axis can keep",
        f"{allowed:g}",
        "allow a larger difference, or tabulate a smaller range of angles or thicknesses",
    )
