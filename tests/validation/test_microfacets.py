"""What the page says of rough surfaces: where Mitsuba agrees, and why its Beckmann differs."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.special import erf

from validation.microfacets import WAVELENGTH_NM, Lobe, both, random_pairs, relative_difference

FloatArray = NDArray[np.float64]

FEW = slice(0, 2000)


@pytest.fixture(scope="module")
def lobes(measured: Callable[[str], Any]) -> list[Lobe]:
    """Compare all surfaces, where Mitsuba runs."""
    return measured("microfacets")


def test_ggx_is_mitsubas(lobes: list[Lobe]) -> None:
    """All directions within 1e-5 relatively, and the same lobe in the plane of incidence."""
    for lobe in lobes:
        if lobe.distribution == "ggx":
            assert lobe.differences.max() < 1e-5
            np.testing.assert_allclose(lobe.ours, lobe.mitsuba, rtol=1e-5)


def test_beckmann_differs_by_walters_approximation(lobes: list[Lobe]) -> None:
    """With the rational masking of Walter et al. 2007, eq 27, in the place of Smith's, 1e-4 remains."""
    beckmann = [lobe for lobe in lobes if lobe.distribution == "beckmann"]
    assert max(lobe.differences.max() for lobe in beckmann) > 1e-3
    i, o = (directions[FEW] for directions in random_pairs())
    for lobe in beckmann:
        ours, theirs = both("beckmann", lobe.alpha, i, o, WAVELENGTH_NM)
        swap = np.prod([rational(slope(v, lobe.alpha)) / smith(slope(v, lobe.alpha)) for v in (i, o)], axis=0)
        assert relative_difference(ours * swap[:, None], theirs).max() < 1e-4


def slope(v: FloatArray, alpha: float) -> FloatArray:
    """Return 1 / (alpha tan theta)."""
    return v[:, 2] / (alpha * np.hypot(v[:, 0], v[:, 1]))


def smith(a: FloatArray) -> FloatArray:
    """Smith's masking of the Beckmann distribution, G1 (Walter et al. 2007, eq 26)."""
    return 2 / (1 + erf(a) + np.exp(-(a**2)) / (a * np.sqrt(np.pi)))


def rational(a: FloatArray) -> FloatArray:
    """Return Walter's approximation of it, equation 27."""
    return np.where(a < 1.6, (3.535 * a + 2.181 * a**2) / (1 + 2.276 * a + 2.577 * a**2), 1.0)


def test_approximation_and_masking_are_within_four_per_mille() -> None:
    """Walter et al. state 0.35 % for equation 27."""
    a = np.linspace(0.01, 4, 2000)
    assert np.abs(rational(a) / smith(a) - 1).max() == pytest.approx(0.0035, abs=0.0005)
