"""kernels/medium.clh: the wave's normal component near its branch points, where textbooks divide by zero."""

import numpy as np
import pytest

from kernel_film import kernel_film, tolerance
from nacreous.opencl.precision import Precision
from reference import film

BOTH = pytest.mark.parametrize("precision", list(Precision))


@BOTH
def test_a_layer_at_its_critical_angle(precision: Precision) -> None:
    """Indices 1.5 / 1.2 / 1.5 at mu = 0.6 is exactly critical: R_s .868541, R_p .730182 (60 digits)."""
    got = kernel_film([1.5, 1.2, 1.5], [500], 550, 0.6, precision=precision)
    assert got.R_s.item() == pytest.approx(0.868541, abs=1e-6)
    assert got.R_p.item() == pytest.approx(0.730182, abs=1e-6)
    assert got.T_s.item() == pytest.approx(1 - 0.868541, abs=1e-6)


@BOTH
@pytest.mark.parametrize("k", [0.0, 1e-9, 1e-6, 1e-3])
def test_around_the_critical_angle(k: float, precision: Precision) -> None:
    """R and T are continuous there: angles ever closer to it on both sides, against extended precision."""
    offset = 10.0 ** -np.arange(1, 8)
    mu = 0.6 + np.concatenate([-offset, [0], offset])
    n = [1.5, 1.2 + 1j * k, 1.5]
    got = np.stack(kernel_film(n, [500], [400, 550, 700], mu, precision=precision))
    at = film(n, [500], [400, 550, 700], mu)
    np.testing.assert_allclose(
        got, np.stack([at.R_s, at.R_p, at.T_s, at.T_p]), rtol=0, atol=max(1e-11, tolerance(precision))
    )


@BOTH
@pytest.mark.parametrize("n_film", [1.0, 1.0 + 1e-6j, 1.33, 0.2 + 3j])
def test_close_to_grazing_incidence(n_film: complex, precision: Precision) -> None:
    """Cosines down to 1e-6, also in a layer of the incident index: nothing cancels and nothing jumps."""
    mu = 10.0 ** -np.arange(1, 7)
    got = np.stack(kernel_film([1, n_film, 1.5], [200], [400, 700], mu, precision=precision))
    at = film([1, n_film, 1.5], [200], [400, 700], mu)
    expected = np.stack([at.R_s, at.R_p, at.T_s, at.T_p])
    np.testing.assert_allclose(got, expected, rtol=0, atol=tolerance(precision))


@BOTH
def test_an_evanescent_gap_decays(precision: Precision) -> None:
    """Frustrated total reflection (Born & Wolf, section 1.5.4): T falls as exp(-4 pi d Im kz / lambda)."""
    d_nm = 800 + 250 * np.arange(3)
    im_kz = np.sqrt(1.5**2 * (1 - 0.3**2) - 1)
    T = np.array([kernel_film([1.5, 1, 1.5], [d], 550, 0.3, precision=precision).T_s.item() for d in d_nm])
    np.testing.assert_allclose(T[1:] / T[:-1], np.exp(-4 * np.pi * 250 * im_kz / 550), rtol=1e-3)


@BOTH
def test_absorption_follows_beer_and_lambert(precision: Precision) -> None:
    """An index-matched absorber: T = exp(-4 pi k d / lambda) at normal incidence, R next to 0."""
    k, d_nm = 1e-4, 5e4
    got = kernel_film([1, 1 + 1j * k, 1], [d_nm], 550, 1, precision=precision)
    assert got.T_p.item() == pytest.approx(np.exp(-4 * np.pi * k * d_nm / 550), rel=1e-4)
    assert got.R_p.item() <= 1e-8
