"""Gauss-Legendre quadrature, kept: to find its nodes takes longer than most integrals do."""

import functools

import numpy as np
from numpy.typing import NDArray

__all__ = ["gauss_legendre"]


@functools.cache
def gauss_legendre(count: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return nodes in [0, 1], ascending, and weights of sum 1, shape (count,) each, read-only."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    scaled = (1 + nodes) / 2, weights / 2
    for array in scaled:
        array.setflags(write=False)
    return scaled
