"""Densities over the square, and the square that they warp it to."""

import numpy as np
import pytest
from scipy.integrate import quad

from nacreous.optics.square_density import SquareDensities, bilinear

RANDOM = np.random.default_rng(5)
VALUES = RANDOM.random((3, 5, 7)) + 0.01
ONE = np.ones((1, 1))


def density_at(slice_: int, x: float, y: float) -> float:
    """Return a density at a point, by NumPy's linear interpolation along rows and then columns."""
    rows = [np.interp(x, np.linspace(0, 1, 7), row) for row in VALUES[slice_]]
    return float(np.interp(y, np.linspace(0, 1, 5), rows))


@pytest.mark.parametrize("slice_", range(3))
@pytest.mark.parametrize(("x", "y"), [(0.31, 0.62), (0.99, 0.01), (0.5, 0.25)])
def test_the_inverse_is_two_integrals(slice_: int, x: float, y: float) -> None:
    """The share of the density in rows before y, and the share before x along the row at y."""
    nodes = np.linspace(0, 1, 7)

    def row(at: float) -> float:
        return quad(lambda u: density_at(slice_, u, at), 0, 1, points=nodes, limit=50, epsabs=1e-6)[0]

    whole, above = (quad(row, 0, end, points=np.linspace(0, end, 5), limit=100)[0] for end in (1.0, y))
    along = quad(lambda u: density_at(slice_, u, y), 0, x, points=nodes[nodes < x], limit=50, epsabs=1e-6)[0]
    densities = SquareDensities.of(VALUES)
    got = densities.inverse(np.array([x]), np.array([y]), np.array([[slice_]]), ONE)
    assert got[0][0] == pytest.approx(along / row(y), abs=1e-7)
    assert got[1][0] == pytest.approx(above / whole, abs=1e-5)


def test_a_mean_of_slices_is_a_density_of_its_own() -> None:
    """Linear interpolation between slices: the inverse of the mean, not the mean of the inverses."""
    densities = SquareDensities.of(VALUES)
    mean = SquareDensities.of(0.25 * densities.density[:1] + 0.75 * densities.density[2:])
    x, y = RANDOM.random((2, 50))
    weights = np.tile([0.25, 0.75], (50, 1))
    got = densities.inverse(x, y, np.tile([0, 2], (50, 1)), weights)
    expected = mean.inverse(x, y, np.zeros((50, 1), int), np.ones((50, 1)))
    np.testing.assert_allclose(got, expected, atol=1e-12)


def test_bilinear_is_exact_where_values_are() -> None:
    """A x + b y + c x y, a value a channel, is met everywhere."""
    x, y = np.meshgrid(np.linspace(0, 1, 4), np.linspace(0, 1, 6))
    values = np.stack([x + 2 * y, 3 * x * y - 1], axis=-1)[None]
    at_x, at_y = RANDOM.random((2, 20))
    got = bilinear(values, at_x, at_y, np.zeros((20, 1), int), np.ones((20, 1)))
    np.testing.assert_allclose(got, np.stack([at_x + 2 * at_y, 3 * at_x * at_y - 1], axis=-1), atol=1e-12)
