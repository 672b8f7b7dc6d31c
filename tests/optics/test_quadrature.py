"""Gauss-Legendre quadrature on [0, 1]."""

import numpy as np
import pytest

from nacreous.optics.quadrature import gauss_legendre


@pytest.mark.parametrize("count", [1, 2, 7, 24, 128])
def test_polynomials_are_integrated_exactly(count: int) -> None:
    """Abramowitz & Stegun 25.4.29: n nodes are exact up to degree 2 n - 1; of x^k it is 1 / (k + 1)."""
    nodes, weights = gauss_legendre(count)
    for degree in range(2 * count):
        assert weights @ nodes**degree == pytest.approx(1 / (degree + 1), rel=1e-11), degree


def test_one_degree_more_is_not() -> None:
    """The error of two nodes for x^4 is 1 / 180: 25.4.30 with the interval's length 1."""
    nodes, weights = gauss_legendre(2)
    assert 1 / 5 - weights @ nodes**4 == pytest.approx(1 / 180, rel=1e-12)


def test_nodes_ascend_inside_the_interval() -> None:
    """0 < x_1 < ... < x_n < 1, symmetric about 1/2, and all weights are positive."""
    nodes, weights = gauss_legendre(33)
    assert (np.diff(nodes) > 0).all()
    assert nodes[0] > 0
    np.testing.assert_allclose(nodes + nodes[::-1], 1, rtol=0, atol=1e-15)
    assert weights.min() > 0


def test_what_is_kept_cannot_be_changed() -> None:
    """Everybody gets the same arrays: they are read-only."""
    for array in gauss_legendre(5):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
