"""Directions of a table: every combination of its angles."""

import numpy as np
import pytest

from nacreous.opencl.film_colour import Side
from nacreous.tables.bsdf.directions import DirectionGrid

GRID = DirectionGrid(
    roughness=np.array([0, 2], np.int32),
    phi_i=np.array([0.0, 0.4, 1.1]),
    theta_i=np.array([0.1, 0.8]),
    theta_o=np.array([0.0, 0.5, 1.0, 1.5]),
    phi=np.array([-3.0, 0.0, 0.3, 2.0, 3.1]),
)


def test_every_combination_once_the_last_axis_fastest() -> None:
    """240 pairs; the place of each is that of a C array over the axes."""
    assert GRID.shape == (2, 3, 2, 4, 5)
    pairs = GRID.pairs(Side.REFLECTION)
    assert len(pairs.roughness) == len(pairs.incoming) == len(pairs.outgoing) == 240
    at = np.ravel_multi_index((1, 2, 1, 3, 4), GRID.shape)
    assert pairs.roughness[at] == 2
    theta_i, phi_i = 0.8, 1.1
    expected = [np.sin(theta_i) * np.cos(phi_i), np.sin(theta_i) * np.sin(phi_i), np.cos(theta_i)]
    np.testing.assert_allclose(pairs.incoming[at], expected)
    theta_o, phi_o = 1.5, 1.1 + 3.1
    expected = [np.sin(theta_o) * np.cos(phi_o), np.sin(theta_o) * np.sin(phi_o), np.cos(theta_o)]
    np.testing.assert_allclose(pairs.outgoing[at], expected)


@pytest.mark.parametrize("side", Side)
def test_directions_are_unit_vectors_on_their_sides(side: Side) -> None:
    """theta_o of transmitted light is measured from -n: it leaves below, at the same azimuth."""
    pairs = GRID.pairs(side)
    for directions in (pairs.incoming, pairs.outgoing):
        np.testing.assert_allclose(np.linalg.norm(directions, axis=-1), 1)
    assert (pairs.incoming[:, 2] > 0).all()
    assert (np.sign(pairs.outgoing[:, 2]) == (1 if side is Side.REFLECTION else -1)).all()
    above = GRID.pairs(Side.REFLECTION).outgoing
    np.testing.assert_array_equal(pairs.outgoing[:, :2], above[:, :2])


def test_phi_is_from_the_incoming_azimuth() -> None:
    """Phi = 0 is the side that the light comes from; its mirror direction is at pi."""
    grid = DirectionGrid(
        np.zeros(1, np.int32), np.array([0.7]), np.array([0.6]), np.array([0.6]), np.array([0, np.pi])
    )
    pairs = grid.pairs(Side.REFLECTION)
    np.testing.assert_allclose(pairs.outgoing[0], pairs.incoming[0])
    np.testing.assert_allclose(pairs.outgoing[1], pairs.incoming[1] * [-1, -1, 1], atol=1e-15)
