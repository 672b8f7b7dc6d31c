"""Half and difference angles against turns of vectors, and what is below the horizon."""

import numpy as np
import pytest

from measured_files import random_diffuse, random_incoming
from nacreous.opencl.bsdf import Pairs
from nacreous.tables.measured.half_difference import HalfDifference, half_difference_of, lower_cosine
from reference_merl import directions_at, half_and_difference


def test_the_angles_are_those_of_turned_vectors() -> None:
    """Rusinkiewicz 1998, equation 3: the half vector at the pole."""
    i, o = random_incoming(300, 1), random_diffuse(300, 2)
    got = half_difference_of(Pairs(np.zeros(300, np.int32), i, o))
    expected = np.array([half_and_difference(*pair) for pair in zip(i, o, strict=True)])
    np.testing.assert_allclose(np.stack([got.theta_h, got.theta_d, got.phi_d], -1), expected, atol=1e-9)


def test_the_directions_have_these_angles() -> None:
    """Both ways, about the x axis."""
    random = np.random.default_rng(3)
    angles = random.uniform([0.0, 0.0, -np.pi], [1.5, 1.5, np.pi], (200, 3))
    pairs = HalfDifference(*angles.T).pairs()
    expected = [directions_at(*at, 0.0) for at in angles]
    np.testing.assert_allclose(pairs.incoming, [pair[0] for pair in expected], atol=1e-12)
    np.testing.assert_allclose(pairs.outgoing, [pair[1] for pair in expected], atol=1e-12)


def test_a_half_vector_at_the_normal_has_an_azimuth_of_its_own() -> None:
    """Perfect mirror directions: no NaN, theta_h = 0."""
    i = random_incoming(50, 4)
    got = half_difference_of(Pairs(np.zeros(50, np.int32), i, i * [-1, -1, 1]))
    np.testing.assert_allclose(got.theta_h, 0, atol=1e-12)
    np.testing.assert_allclose(got.theta_d, np.arccos(i[:, 2]), atol=1e-9)
    assert np.isfinite(got.phi_d).all()


def test_above_moves_only_what_is_below() -> None:
    """The lower direction is then just above the horizon, with the same half vector and azimuth."""
    random = np.random.default_rng(5)
    angles = HalfDifference(*random.uniform([0.0, 0.0, -np.pi], [1.56, np.pi / 2, np.pi], (2000, 3)).T)
    lower = lower_cosine(angles.theta_h, angles.theta_d, np.cos(angles.phi_d))
    np.testing.assert_allclose(
        lower, np.minimum(*(d[:, 2] for d in (angles.pairs().incoming, angles.pairs().outgoing))), atol=1e-12
    )
    moved = angles.above()
    kept = lower > 2e-3
    np.testing.assert_allclose(moved.theta_d[kept], angles.theta_d[kept])
    below = lower < 0
    np.testing.assert_allclose(np.minimum(*_cosines(moved))[below], 1e-3, atol=1e-9)
    np.testing.assert_allclose(moved.phi_d, angles.phi_d)
    assert (np.minimum(*_cosines(moved)) >= 1e-3 - 1e-12).all()


def _cosines(angles: HalfDifference) -> tuple[np.ndarray, np.ndarray]:
    pairs = angles.pairs()
    return pairs.incoming[:, 2], pairs.outgoing[:, 2]


@pytest.mark.parametrize("angle", [np.pi / 2, np.pi / 2 - 1e-9])
def test_the_flattest_half_vector_still_has_directions(angle: float) -> None:
    """Where hardly any light is above the surface, what remains is."""
    flat = HalfDifference(np.full(3, angle), np.full(3, 1.0), np.array([0.0, 1.0, np.pi / 2]))
    assert (np.minimum(*_cosines(flat.above())) > 0).all()
