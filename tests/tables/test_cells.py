"""Cells between the samples of an axis."""

import numpy as np
import pytest

from nacreous.tables.cells import Cells, middle_of


def test_all_cells_of_a_short_axis() -> None:
    """Neighbours, in order; the middles lie between them."""
    cells = Cells.along(np.array([0.0, 1.0, 3.0, 4.0]), 10)
    np.testing.assert_array_equal(cells.lower, [0, 1, 3])
    np.testing.assert_array_equal(cells.upper, [1, 3, 4])
    np.testing.assert_array_equal(cells.middles, [0.5, 2, 3.5])
    np.testing.assert_array_equal(cells.corners, [0, 1, 3, 1, 3, 4])


@pytest.mark.parametrize(("size", "most"), [(100, 7), (8, 7), (1000, 2), (9, 8)])
def test_some_cells_of_a_long_axis(size: int, most: int) -> None:
    """No more than asked for, the outermost among them, each of neighbours."""
    cells = Cells.along(np.arange(size, dtype=float), most)
    assert cells.lower.size == most
    assert cells.lower[0] == 0
    assert cells.upper[-1] == size - 1
    np.testing.assert_array_equal(cells.upper - cells.lower, 1)


def test_one_value_is_one_cell_without_width() -> None:
    """There is nothing between it, and its middle is itself."""
    cells = Cells.along(np.array([0.7]), 5)
    assert cells.lower == cells.upper == cells.middles == 0.7


def test_chosen_cells() -> None:
    """A mask keeps both ends."""
    cells = Cells.along(np.arange(5.0), 9).where(np.array([True, False, False, True]))
    np.testing.assert_array_equal(cells.middles, [0.5, 3.5])


def test_linear_functions_are_interpolated_exactly() -> None:
    """The middle of a function linear in each axis is its value there; other axes stay."""
    x, y, z = (Cells.along(axis, 9) for axis in (np.arange(4.0), np.array([1.0, 5, 6]), np.array([2.0])))

    def function(*axes: np.ndarray) -> np.ndarray:
        a, b, c = np.meshgrid(*axes, indexing="ij")
        return np.stack([1 + a + 2 * b * c - a * b, a * b * c])

    corners = function(x.corners, y.corners, z.corners)
    np.testing.assert_allclose(middle_of(corners, 3), function(x.middles, y.middles, z.middles), atol=1e-12)
    one = middle_of(corners, 1, first=2)
    np.testing.assert_allclose(one, function(x.corners, y.middles, z.corners), atol=1e-12)


def test_curvature_is_missed() -> None:
    """Linear interpolation of x^2 amid a cell of width w is off by w^2 / 4."""
    cells = Cells.along(np.array([0.0, 1.0, 3.0]), 9)
    error = middle_of(cells.corners[None] ** 2, 1)[0] - cells.middles**2
    np.testing.assert_allclose(error, [0.25, 1.0])
