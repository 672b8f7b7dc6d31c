"""The warp of the unit square: kernels/warp.cl."""

import numpy as np
import pytest

from nacreous.errors import BudgetError
from nacreous.opencl import tiles
from nacreous.opencl.device import Device
from nacreous.opencl.precision import Precision
from nacreous.opencl.warp import warped
from nacreous.optics.square_density import SquareDensities

RANDOM = np.random.default_rng(11)
VALUES = RANDOM.random((4, 9, 17)) ** 3 + 1e-4
POINTS = RANDOM.random((500, 2))
TOLERANCE = {Precision.SINGLE: 2e-5, Precision.DOUBLE: 1e-12}


@pytest.mark.parametrize("precision", Precision)
def test_the_warp_and_its_inverse_are_one(precision: Precision, device: Device) -> None:
    """Points come back through the inverse, which tests/optics/test_square_density.py integrates."""
    densities = SquareDensities.of(VALUES)
    places = np.asarray(warped(device, densities, POINTS, precision), np.float64)
    for slice_, (x, y) in enumerate(places.transpose(0, 2, 1)):
        one, which = np.ones((len(POINTS), 1)), np.full((len(POINTS), 1), slice_)
        back = np.stack(densities.inverse(x, y, which, one), axis=-1)
        np.testing.assert_allclose(back, POINTS, rtol=0, atol=TOLERANCE[precision])


def test_corners_stay_and_an_even_density_moves_nothing(device: Device) -> None:
    """The warp of a constant is the identity; of any density it keeps the corners."""
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]])
    even = SquareDensities.of(np.ones((1, 3, 5)))
    np.testing.assert_allclose(warped(device, even, POINTS, Precision.DOUBLE)[0], POINTS, atol=1e-12)
    moved = warped(device, SquareDensities.of(VALUES), corners, Precision.DOUBLE)
    np.testing.assert_allclose(moved, np.tile(corners, (4, 1, 1)), atol=1e-12)


def test_rows_without_density_are_passed_over(device: Device) -> None:
    """No point lies where the density is 0, and none is NaN."""
    values = np.zeros((1, 6, 6))
    values[0, 3:, 2:4] = 1
    places = warped(device, SquareDensities.of(values), POINTS, Precision.DOUBLE)[0]
    assert (places[:, 1] >= 0.4 - 1e-12).all()
    assert ((places[:, 0] >= 0.2 - 1e-12) & (places[:, 0] <= 0.8 + 1e-12)).all()


def test_tiles_do_not_matter(device: Device, monkeypatch: pytest.MonkeyPatch) -> None:
    """A point at a time or all at once: the same bytes."""
    densities = SquareDensities.of(VALUES)
    whole = warped(device, densities, POINTS, Precision.SINGLE)
    monkeypatch.setattr(tiles, "_FIRST_TILE_EVALUATIONS", 1)
    monkeypatch.setattr(tiles, "_MOST_GROWTH", 1)
    assert warped(device, densities, POINTS, Precision.SINGLE).tobytes() == whole.tobytes()


def test_too_many_points_are_refused(device: Device, monkeypatch: pytest.MonkeyPatch) -> None:
    """Before anything is allocated; the message has the size."""
    monkeypatch.setenv("NACREOUS_BYTE_BUDGET", "1000")
    with pytest.raises(BudgetError, match="4 x 500 points"):
        warped(device, SquareDensities.of(VALUES), POINTS, Precision.DOUBLE)
