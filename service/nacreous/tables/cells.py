"""Cells between the samples of an axis, where linear interpolation is at its worst."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

__all__ = ["Cells", "middle_of"]

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Cells:
    """Cells along one axis: each lies between `lower` and `upper`, shape (C,), and may have no width."""

    lower: FloatArray
    upper: FloatArray

    @classmethod
    def along(cls, axis: FloatArray, most: int) -> Self:
        """At most `most` cells of an axis, evenly spread, the outermost included; one value is one cell."""
        if axis.size == 1:
            return cls(axis, axis)
        first = np.unique(np.linspace(0, axis.size - 2, min(most, axis.size - 1)).round().astype(int))
        return cls(axis[first], axis[first + 1])

    def where(self, chosen: NDArray[np.bool_]) -> Self:
        """Those of the cells that a mask of shape (C,) chooses."""
        return type(self)(self.lower[chosen], self.upper[chosen])

    @property
    def corners(self) -> FloatArray:
        """Lower ends, then upper ends, shape (2 C,)."""
        return np.concatenate([self.lower, self.upper])

    def samples(self) -> tuple[FloatArray, NDArray[np.intp]]:
        """Return the ends of all cells once, ascending, and where among them each of `corners` is.

        Neighbours share an end, so that there are half as many as corners, or as many where cells lie apart.
        """
        values, position = np.unique(self.corners, return_inverse=True)
        return values, position

    @property
    def middles(self) -> FloatArray:
        """Midpoints, shape (C,)."""
        return (self.lower + self.upper) / 2


def middle_of(corners: FloatArray, axes: int, first: int = 1) -> FloatArray:
    """Linear interpolation amid cells over `axes` axes from `first` on, lower corners first in each."""
    for axis in range(first, first + axes):
        lower, upper = np.split(corners, 2, axis)
        corners = (lower + upper) / 2
    return corners
