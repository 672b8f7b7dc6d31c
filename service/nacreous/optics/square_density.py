"""Densities over the unit square, bilinear between their samples, and the square that they warp it to.

A renderer samples such a density by its marginal over the rows, y, and then along the row, x. The warp takes
a point, uniformly distributed, to one that follows the density; here is its inverse, of which a file's
coordinates are made. Source: Dupuy and Jakob, "An adaptive parameterization for efficient material
acquisition and rendering", 2018, section 4.2; as Mitsuba 3 and pbrt-v4 carry it out.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

__all__ = ["SquareDensities", "bilinear"]

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int_]


@dataclass(frozen=True, eq=False)
class SquareDensities:
    """One density for each of S slices, of integral 1, on a grid of H rows and W columns with its ends.

    Parameters
    ----------
    density : float array, shape (S, H, W)
    conditional : float array, shape (S, H, W)
        Integral along each row from x = 0.
    marginal : float array, shape (S, H)
        Integral of whole rows from y = 0; it ends at 1.
    """

    density: FloatArray
    conditional: FloatArray
    marginal: FloatArray

    @classmethod
    def of(cls, values: FloatArray) -> Self:
        """Return the densities that positive `values`, shape (S, H, W), are multiples of."""
        conditional = _integrated(values)
        marginal = _integrated(conditional[..., -1])
        whole = marginal[:, -1]
        return cls(
            values / whole[:, None, None], conditional / whole[:, None, None], marginal / whole[:, None]
        )

    def inverse(
        self, x: FloatArray, y: FloatArray, slices: IntArray, weights: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the points that the warp takes to x and y, (P,) each.

        Parameters
        ----------
        x, y : float arrays, shape (P,)
        slices : int array, shape (P, N)
        weights : float array, shape (P, N)
            The density is the mean of these slices with these weights.
        """
        (_, height, width) = self.density.shape
        column, across = _cell(x, width)
        row, down = _cell(y, height)

        def at(values: FloatArray, *place: IntArray) -> FloatArray:
            return _mean(values, slices, weights, *place)

        left, right = (
            _mixed(at(self.density, row, c), at(self.density, row + 1, c), down) for c in (column, column + 1)
        )
        before = _mixed(at(self.conditional, row, column), at(self.conditional, row + 1, column), down)
        end = np.full_like(row, width - 1)
        whole, next_whole = at(self.conditional, row, end), at(self.conditional, row + 1, end)
        along = before + _part(across, left, right) / (width - 1)
        above = at(self.marginal, row) + _part(down, whole, next_whole) / (height - 1)
        return along / _mixed(whole, next_whole, down), above


def bilinear(
    values: FloatArray, x: FloatArray, y: FloatArray, slices: IntArray, weights: FloatArray
) -> FloatArray:
    """Return the mean over slices of values (S, H, W, C), bilinear at points (P,) of the square: (P, C)."""
    column, across = _cell(x, values.shape[2])
    row, down = _cell(y, values.shape[1])
    corners = (
        (row, column, (1 - down) * (1 - across)),
        (row, column + 1, (1 - down) * across),
        (row + 1, column, down * (1 - across)),
        (row + 1, column + 1, down * across),
    )
    return np.asarray(
        sum(_mean(values, slices, weights * share[:, None], at_row, at) for at_row, at, share in corners)
    )


def _integrated(values: FloatArray) -> FloatArray:
    """Integral along the last axis from its first sample, by trapezoids: exact between linear samples."""
    sums = np.zeros(values.shape)
    np.cumsum((values[..., 1:] + values[..., :-1]) / 2, axis=-1, out=sums[..., 1:])
    return np.asarray(sums / (values.shape[-1] - 1))


def _cell(at: FloatArray, samples: int) -> tuple[IntArray, FloatArray]:
    """Return the cell of a coordinate from 0 to 1, and the place in it."""
    place = np.clip(at, 0, 1) * (samples - 1)
    cell = np.minimum(place.astype(np.int_), samples - 2)
    return cell, place - cell


def _mixed(a: FloatArray, b: FloatArray, share: FloatArray) -> FloatArray:
    return np.asarray(a + share * (b - a))


def _part(share: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    """Integral of what is linear from a to b over a part of a cell of width 1."""
    return np.asarray(share * _mixed(a, b, share / 2))


def _mean(values: FloatArray, slices: IntArray, weights: FloatArray, *place: IntArray) -> FloatArray:
    picked = values[(slices, *(at[:, None] for at in place))]  # (P, N) or (P, N, C)
    return np.asarray(np.einsum("pn,pn...->p...", weights, picked))
