"""Linear interpolation along several axes at once, as readers of tables do it."""

from collections.abc import Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray

__all__ = ["interval", "multilinear"]

FloatArray = NDArray[np.float64]


def multilinear(
    table: NDArray[np.floating], axes: Sequence[FloatArray], at: Sequence[FloatArray]
) -> FloatArray:
    """Interpolate a table (N_1, …, N_d, C) over ascending axes (N_k,) at points (P,) each: (P, C).

    Beyond the ends of an axis the outermost values hold.
    """
    cells = [interval(nodes, values) for nodes, values in zip(axes, at, strict=True)]
    total = np.zeros((at[0].size, table.shape[-1]))
    for corner in product((0, 1), repeat=len(axes)):
        places = tuple(first + side for (first, _), side in zip(cells, corner, strict=True))
        weights = [share if side else 1 - share for (_, share), side in zip(cells, corner, strict=True)]
        total += np.prod(weights, axis=0)[:, None] * table[places]
    return total


def interval(nodes: FloatArray, at: FloatArray) -> tuple[NDArray[np.int_], FloatArray]:
    """Return the interval of an axis that values lie in, or are nearest to, and their place in it."""
    first = np.clip(np.searchsorted(nodes, at, side="right") - 1, 0, nodes.size - 2)
    return first, np.clip((at - nodes[first]) / (nodes[first + 1] - nodes[first]), 0, 1)
