"""A film whose thickness varies over its surface: the nodes that R and T are averaged over.

Each layer's thickness is normally distributed, independently of the others; the members of a repeated group
vary together. The average is the trapezoid rule under the normal density, with as many nodes as it takes:
its error falls as exp(-(2 pi / step - w)^2 / 2) for a fringe of frequency w, so that the nodes grow with the
number of fringes within the spread (Gauss-Hermite nodes grow with its square).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.optics.stack import Stack, sample_stack

__all__ = ["ThicknessSpread", "converged_spread", "one_thickness"]

FloatArray = NDArray[np.float64]

TOLERANCE = 2e-5
"""Change of R and T on doubling the nodes at which they are enough: a fifth of the 1e-4 promised."""
_REACH = 5.0
"""Standard deviations within which nodes count; what lies beyond has a probability of 6e-7."""
_FEWEST_NODES, _MOST_NODES, _MOST_VARIANTS = 9, 4608, 16_384


@dataclass(frozen=True, eq=False)
class ThicknessSpread:
    """Thickness variants and their weights.

    Parameters
    ----------
    offset_nm : float array, shape (V, M)
        What is added to each layer's mean thickness.
    weights : float array, shape (V,)
        Of sum 1.
    """

    offset_nm: FloatArray
    weights: FloatArray


def one_thickness(layers: int) -> ThicknessSpread:
    """Return the spread of a film without one."""
    return ThicknessSpread(np.zeros((1, layers)), np.ones(1))


def converged_spread(
    stack: Stack, wavelength_nm: FloatArray, mean_intensities: Callable[[ThicknessSpread], FloatArray]
) -> ThicknessSpread:
    """Return nodes so many that doubling those of any one layer changes R and T by less than `TOLERANCE`.

    Parameters
    ----------
    stack : Stack
    wavelength_nm : float array, shape (L,)
    mean_intensities : callable
        R and T, in double precision, of the film averaged over a spread.

    Raises
    ------
    SpecError
        The nodes of several layers together are too many.
    """
    sampled = sample_stack(stack, wavelength_nm)
    sigma_nm = sampled.thickness_sigma_nm
    counts = np.ones(sigma_nm.size, int)
    for layer in np.flatnonzero(sigma_nm):
        counts[layer] = _converged_count(int(layer), sigma_nm, mean_intensities)
    return _spread(sigma_nm, counts)


def _converged_count(
    layer: int, sigma_nm: FloatArray, mean_intensities: Callable[[ThicknessSpread], FloatArray]
) -> int:
    """Nodes of one layer, the others at their mean."""

    def average(count: int) -> FloatArray:
        counts = np.ones(sigma_nm.size, int)
        counts[layer] = count
        return mean_intensities(_spread(sigma_nm, counts))

    count, coarse = _FEWEST_NODES, average(_FEWEST_NODES)
    while count < _MOST_NODES:
        fine = average(2 * count)
        if np.abs(fine - coarse).max() < TOLERANCE:
            return count
        count, coarse = 2 * count, fine
    return count


def _spread(sigma_nm: FloatArray, counts: NDArray[np.int_]) -> ThicknessSpread:
    """Every combination of the layers' nodes."""
    rules = [_nodes(int(count)) for count in counts]
    variants = math.prod(len(nodes) for nodes, _ in rules)  # exact: 9^20 is beyond 64 bits
    if variants > _MOST_VARIANTS:
        raise SpecError(
            "stack.layers",
            f"thickness spreads of at most {_MOST_VARIANTS:,} combinations",
            f"{variants:,}",
            "give fewer layers a thickness_sigma_nm, or smaller ones",
        )
    offset_nm = np.array(list(product(*(nodes for nodes, _ in rules)))) * sigma_nm  # (V, M)
    weights = np.array([np.prod(weights) for weights in product(*(weights for _, weights in rules))])
    return ThicknessSpread(offset_nm, weights)


def _nodes(count: int) -> tuple[FloatArray, FloatArray]:
    """Equidistant nodes in standard deviations and weights of sum 1; one node is the mean."""
    nodes = np.linspace(-_REACH, _REACH, count) if count > 1 else np.zeros(1)
    weights = np.exp(-(nodes**2) / 2)
    return nodes, weights / weights.sum()
