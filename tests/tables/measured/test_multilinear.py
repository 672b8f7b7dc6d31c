"""Interpolation along several axes against a function that it meets exactly."""

import numpy as np

from nacreous.tables.measured.multilinear import multilinear

AXES = (np.array([0.0, 0.3, 1.0]), np.array([-1.0, 0.0, 0.5, 2.0]), np.array([0.0, 1.0]))


def test_a_product_of_linear_functions_is_met_exactly() -> None:
    """(a + b x)(c + d y)(e + f z) is linear along each axis, anywhere."""

    def product(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
        return np.stack([(1 + 2 * x) * (3 - y) * (0.5 + z), (2 - x) * (y + 4) * z], axis=-1)

    table = product(*np.meshgrid(*AXES, indexing="ij"))
    at = np.random.default_rng(1).uniform([0, -1, 0], [1, 2, 1], (100, 3)).T
    np.testing.assert_allclose(multilinear(table, AXES, tuple(at)), product(*at), rtol=1e-12)


def test_samples_are_met_and_the_outermost_hold() -> None:
    """What volume textures with clamped addresses do, and Mitsuba."""
    table = np.random.default_rng(2).random((3, 4, 2, 1))
    grid = [axis.ravel() for axis in np.meshgrid(*AXES, indexing="ij")]
    np.testing.assert_allclose(multilinear(table, AXES, grid).ravel(), table.ravel(), rtol=1e-12)
    outside = [np.array([9.0]), np.array([-9.0]), np.array([0.0])]
    np.testing.assert_allclose(multilinear(table, AXES, outside), table[2, 0, 0][None])
