"""Albedo grids that keep a promise: few texels that hold ``[accuracy] delta_e``.

Each axis is refined by itself for a share of the allowed difference, and several shares are tried. The
smallest of the tables is widened until the difference holds in every cell, and slimmed while it does.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.tables.albedo.certificate import AlbedoCells, colour_differences
from nacreous.tables.albedo.solver import AlbedoSolver
from nacreous.tables.cells import Cells
from nacreous.tables.colour import Colouring
from nacreous.tables.film import Grid
from nacreous.tables.fresnel.refine import fewest, spaced, unreachable
from nacreous.tables.solver import probe

__all__ = ["refined"]

FloatArray = NDArray[np.float64]
Axes = tuple[FloatArray, FloatArray, FloatArray]
"""Roughness (R,), thickness scale (S,) and cosine (A,)."""

_SHARES: dict[int, tuple[tuple[float, ...], ...]] = {
    1: ((0.97,),),
    2: ((0.3, 0.65), (0.475, 0.475), (0.65, 0.3)),
    3: ((0.3, 0.3, 0.3), (0.15, 0.6, 0.2), (0.2, 0.2, 0.55)),
}
"""Parts of the allowed difference that each refined axis may use up, by how many axes there are."""
_PROBES = 3
"""Values of the other axes at which one is refined by itself."""
_GROWTH = (1.05, 1.5)
"""Least and largest growth of a count while a cell does not hold."""
_MOST_TEXELS = 2**16
"""Texels to which a table is refined: all cells of that many take seconds to measure, again and again."""


def refined(
    solver: AlbedoSolver, roughness: FloatArray, grid: Grid, colouring: Colouring, delta_e: float
) -> tuple[FloatArray, Grid]:
    """Return roughnesses and a grid with as many samples as `delta_e` needs, the spec's own at least.

    An axis of one value stays as it is; a refined one is spaced as the spec's is.

    Raises
    ------
    SpecError
        No grid of at most 65,536 texels is fine enough.
    """
    axes: Axes = (roughness, grid.thickness_scale, grid.cos_theta)
    search = _Search(solver, colouring, grid, delta_e, max(_MOST_TEXELS, _texels(axes)))
    open_axes = [at for at, values in enumerate(axes) if values.size > 1]
    tables = [
        search.alone(axes, dict(zip(open_axes, shares, strict=True))) for shares in _SHARES[len(open_axes)]
    ]
    smallest = min(tables, key=_texels)
    if _texels(smallest) > search.most_texels:
        raise search.too_many()
    holding = search.holding(smallest, open_axes)
    chosen = search.slimmed(holding, axes, open_axes)
    return chosen[0], replace(grid, thickness_scale=chosen[1], cos_theta=chosen[2])


@dataclass(frozen=True, eq=False)
class _Search:
    solver: AlbedoSolver
    colouring: Colouring
    grid: Grid
    delta_e: float
    most_texels: int

    def alone(self, axes: Axes, shares: dict[int, float]) -> Axes:
        """Refine each axis of `shares` by itself, for its share of the difference."""
        counts = [values.size for values in axes]
        for at, share in shares.items():
            counts[at] = self._fewest(axes, at, share * self.delta_e)
        return _respaced(axes, counts)

    def holding(self, axes: Axes, open_axes: list[int]) -> Axes:
        """Widen a table until it holds in all of its cells, each time along the axis that helps most."""
        while (worst := self.worst(axes)) > self.delta_e:
            growth = float(np.clip((worst / self.delta_e) ** 0.5, *_GROWTH))
            wider = [_counted(axes, at, math.ceil(growth * axes[at].size)) for at in open_axes]
            axes = min(wider, key=self.worst)
            if _texels(axes) > self.most_texels:
                raise self.too_many()
        return axes

    def slimmed(self, holding: Axes, least: Axes, open_axes: list[int]) -> Axes:
        """Take samples off each axis in turn, by halving, while all cells hold; at least those of `least`."""
        for at in open_axes:
            low, high = least[at].size - 1, holding[at].size
            while high - low > max(1, low // 32):
                middle = (low + high) // 2
                slimmer = _counted(holding, at, middle)
                low, high = (low, middle) if self.worst(slimmer) <= self.delta_e else (middle, high)
            holding = _counted(holding, at, high)
        return holding

    def worst(self, axes: Axes) -> float:
        """Largest difference in all cells of a table, against the albedo between its texels.

        That is computed as the texels are, within 1e-4 of the exact one: the certificate measures that.
        """
        return self._difference(tuple(Cells.along(values, values.size) for values in axes))

    def too_many(self) -> SpecError:
        """Return the refusal of a difference that only a larger table keeps."""
        return SpecError(
            "accuracy.delta_e",
            f"a difference that a table of {self.most_texels:,} texels can keep",
            f"{self.delta_e:g}",
            "allow a larger difference, or tabulate a smaller range of roughness or thickness",
        )

    def _fewest(self, axes: Axes, at: int, allowed: float) -> int:
        def error(count: int) -> float:
            if count * _texels(axes) // axes[at].size > self.most_texels:
                raise self.too_many()
            few = [Cells(values, values) for values in (probe(axis, _PROBES) for axis in axes)]
            values = spaced(axes[at], count)
            few[at] = Cells.along(values, values.size)
            return self._difference(tuple(few))

        count = fewest(error, axes[at].size, allowed)
        if count is None:
            raise unreachable(self.delta_e)
        return count

    def _difference(self, cells: tuple[Cells, ...]) -> float:
        chosen = AlbedoCells(*cells)
        return float(colour_differences(self.solver, chosen, self.grid, self.colouring).max())


def _respaced(axes: Axes, counts: list[int]) -> Axes:
    roughness, scale, cosine = (spaced(axis, count) for axis, count in zip(axes, counts, strict=True))
    return roughness, scale, cosine


def _counted(axes: Axes, at: int, count: int) -> Axes:
    counts = [values.size for values in axes]
    counts[at] = count
    return _respaced(axes, counts)


def _texels(axes: Axes) -> int:
    return math.prod(values.size for values in axes)
