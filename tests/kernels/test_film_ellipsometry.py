"""kernels/film_ellipsometry.cl against tmm's ellips."""

import numpy as np
import pytest
import tmm

from kernel_film import one_run, plain_problem
from nacreous.opencl.device import Device
from nacreous.opencl.film_ellipsometry import film_ellipsometry
from nacreous.opencl.precision import Precision
from reference import film

BOTH = pytest.mark.parametrize(
    ("precision", "allowed"), [(Precision.DOUBLE, 1e-10), (Precision.SINGLE, 1e-4)]
)


def turn(difference: np.ndarray) -> np.ndarray:
    """Return the smaller way round of a difference of angles, which are the same modulo 2 pi."""
    return np.abs((difference + np.pi) % (2 * np.pi) - np.pi)


def test_the_numbers_of_tmms_own_suite(device: Device) -> None:
    """Tmm 0.2, tests.py, `basic_test`: psi and Delta of two absorbing layers on an absorbing substrate."""
    problem = one_run(plain_problem([1, 2 + 4j, 3 + 0.3j, 1 + 0.1j], [2, 3], 100, np.cos(0.1)))
    got = film_ellipsometry(device, problem, Precision.DOUBLE)
    assert got["psi"].item() == pytest.approx(0.78366777347038352, abs=1e-12)
    assert got["Delta"].item() == pytest.approx(0.0021460774404193292, abs=1e-12)


@BOTH
@pytest.mark.parametrize("seed", range(6))
def test_tmm_agrees(seed: int, precision: Precision, allowed: float, device: Device) -> None:
    """Random absorbing stacks at an oblique angle; Delta is compared on the circle."""
    rng = np.random.default_rng(seed)
    layers = int(rng.integers(1, 6))
    index = [1.0, *(rng.uniform(1.2, 3, layers + 1) + 1j * rng.uniform(0, 1, layers + 1))]
    d_nm, mu = rng.uniform(5, 200, layers), float(rng.uniform(0.2, 0.95))
    got = film_ellipsometry(device, one_run(plain_problem(index, d_nm, 550, mu)), precision)
    expected = tmm.ellips(index, [np.inf, *d_nm, np.inf], np.arccos(mu), 550)
    assert got["psi"].item() == pytest.approx(expected["psi"], abs=allowed)
    assert turn(got["Delta"] - expected["Delta"]).item() <= allowed


@BOTH
def test_a_group_and_many_layers(precision: Precision, allowed: float, device: Device) -> None:
    """The common factor that keeps a field in range cancels in r_p / r_s, for groups, too."""
    n, d_nm, mu = [1, 1.56 + 0.06j, 1.0, 1.5], [90.0, 100.0], [0.2, 0.6, 0.95]
    wavelength_nm = np.linspace(400, 700, 21)
    problem = plain_problem(n, d_nm, wavelength_nm, mu, groups=[(0, 2, 24)])
    got, at = (
        film_ellipsometry(device, problem, precision),
        film(n, d_nm, wavelength_nm, mu, groups=[(0, 2, 24)]),
    )
    np.testing.assert_allclose(got["psi"][0], at.psi, rtol=0, atol=10 * allowed)
    assert turn(got["Delta"][0] - at.Delta).max() <= 10 * allowed


@BOTH
@pytest.mark.parametrize("gap_nm", [50.0, 400.0])
def test_strong_fields_stay_in_range(
    gap_nm: float, precision: Precision, allowed: float, device: Device
) -> None:
    """Quarter waves of 9,000 about a gap of 0.01 grow s by 1e8 and p by 1e12; r_p / r_s has their squares."""
    n, d_nm, mu = [1, 9e3, 0.01, 9e3, 1.5], [1000 / 4 / 9e3, gap_nm, 1000 / 4 / 9e3], [0.2, 0.4, 0.8]
    got = film_ellipsometry(device, one_run(plain_problem(n, d_nm, 1000, mu)), precision)
    at = film(n, d_nm, 1000, mu)
    np.testing.assert_allclose(got["psi"][0], at.psi, rtol=0, atol=allowed)
    assert turn(got["Delta"][0] - at.Delta).max() <= allowed


def test_normal_incidence_knows_no_polarisation(device: Device) -> None:
    """At mu = 1, s and p are the same: psi = pi / 4, Delta = 0."""
    got = film_ellipsometry(
        device, one_run(plain_problem([1, 2.0, 1.5 + 1j], [120], 550, 1)), Precision.DOUBLE
    )
    assert got["psi"].item() == pytest.approx(np.pi / 4, abs=1e-12)
    assert got["Delta"].item() == pytest.approx(0, abs=1e-12)
