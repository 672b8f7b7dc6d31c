"""kernels/film_colour.cl: the same intensities as an independent film, weighted and summed."""

import numpy as np
import pytest

from kernel_film import one_run, plain_problem, tolerance
from lane_widths import lane_widths
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side, film_colours
from nacreous.opencl.precision import Precision
from reference import Intensities, film, incoherent_film

BOTH = pytest.mark.parametrize("precision", list(Precision))
WAVELENGTH_NM = np.linspace(380, 780, 53)
MU = np.linspace(0, 1, 13)
WEIGHTS = np.random.default_rng(7).uniform(-1, 2, (3, WAVELENGTH_NM.size)) / WAVELENGTH_NM.size


def integrated(at: Intensities, side: Side) -> np.ndarray:
    """Sum the unpolarised spectra of the reference, (A, 3)."""
    s, p = (at.R_s, at.R_p) if side is Side.REFLECTION else (at.T_s, at.T_p)
    return np.asarray((s + p) / 2 @ WEIGHTS.T)


@BOTH
@pytest.mark.parametrize("side", list(Side))
def test_colour_is_the_weighted_sum_of_intensities(side: Side, precision: Precision, device: Device) -> None:
    """C = sum over the wavelengths of w (s + p) / 2; 53 wavelengths fill no lanes, and padding weighs 0."""
    n, d_nm = [1, 2.1, 1.4 + 0.01j, 1.5], [420, 150]
    problem = one_run(plain_problem(n, d_nm, WAVELENGTH_NM, MU))
    at = film(n, d_nm, WAVELENGTH_NM, MU)
    expected = integrated(Intensities(at.R_s, at.R_p, at.T_s, at.T_p), side)
    for lanes in lane_widths(device, precision):
        (got,) = film_colours(device, problem, WEIGHTS, (side,), precision, lanes=lanes)
        np.testing.assert_allclose(got[0], expected, rtol=0, atol=tolerance(precision))


@BOTH
@pytest.mark.parametrize("side", list(Side))
def test_a_thick_layer_and_a_group(side: Side, precision: Precision, device: Device) -> None:
    """The fused kernel takes every kind of segment."""
    n, d_nm = [1, 2.35, 1.38, 1.52 + 1e-7j, 1], [58, 100, 1e5]
    kinds = {"coherent": [True, True, False], "groups": [(0, 2, 3)]}
    problem = plain_problem(n, d_nm, WAVELENGTH_NM, MU, **kinds)
    (got,) = film_colours(device, problem, WEIGHTS, (side,), precision)
    expected = integrated(incoherent_film(n, d_nm, WAVELENGTH_NM, MU, **kinds), side)
    np.testing.assert_allclose(got[0], expected, rtol=0, atol=10 * tolerance(precision))


@BOTH
def test_both_sides_at_once_are_either_by_itself(precision: Precision, device: Device) -> None:
    """The film is crossed once for R and T; the order asked for is the order given."""
    problem = one_run(plain_problem([1, 2.1, 1.4 + 0.01j, 1.5], [420, 150], WAVELENGTH_NM, MU))
    together = film_colours(device, problem, WEIGHTS, (Side.TRANSMISSION, Side.REFLECTION), precision)
    assert together.shape == (2, 1, MU.size, 3)
    at = film([1, 2.1, 1.4 + 0.01j, 1.5], [420, 150], WAVELENGTH_NM, MU)
    for got, side in zip(together, (Side.TRANSMISSION, Side.REFLECTION), strict=True):
        expected = integrated(Intensities(at.R_s, at.R_p, at.T_s, at.T_p), side)
        np.testing.assert_allclose(got[0], expected, rtol=0, atol=tolerance(precision))
