"""Each formula against a published index, or against arithmetic that can be done by hand."""

import numpy as np
import pytest

from nacreous.optics import dispersion

D_LINE_UM = np.array([0.5875618])
"""The yellow helium line, at which glass catalogues state n_d."""


def test_sellmeier_gives_fused_silica() -> None:
    """Malitson 1965: n_d = 1.45846 from the resonances 0.0684043, 0.1162414 and 9.896161 um."""
    terms = [(0.6961663, 0.0684043), (0.4079426, 0.1162414), (0.8974794, 9.896161)]
    assert dispersion.sellmeier(D_LINE_UM, 0.0, terms) == pytest.approx(1.45846, abs=5e-6)


def test_sellmeier_2_gives_bk7() -> None:
    """SCHOTT N-BK7 data sheet: n_d = 1.51680."""
    terms = [(1.03961212, 0.00600069867), (0.231792344, 0.0200179144), (1.01046945, 103.560653)]
    assert dispersion.sellmeier_2(D_LINE_UM, 0.0, terms) == pytest.approx(1.51680, abs=5e-6)


def test_polynomial_gives_bk7() -> None:
    """SCHOTT's older power series for BK7 has the same n_d = 1.51680."""
    terms = [
        (-1.0108077e-2, 2),
        (1.0592509e-2, -2),
        (2.0816965e-4, -4),
        (-7.6472538e-6, -6),
        (4.9240991e-7, -8),
    ]
    assert dispersion.polynomial(D_LINE_UM, 2.2718929, terms) == pytest.approx(1.51680, abs=1e-5)


def test_mixed_form_by_hand() -> None:
    """At 2 um: 1 + 3·2²/(2² - 2¹) + 4·2⁻¹ = 9, so n = 3."""
    assert dispersion.mixed_form(
        np.array([2.0]), 1.0, [(3.0, 2.0, 2.0, 1.0)], [(4.0, -1.0)]
    ) == pytest.approx(3.0)


@pytest.mark.parametrize(("wavelength_um", "n"), [(0.4, 1.572), (0.5, 1.552), (0.6, 1.541)])
def test_cauchy_gives_butterfly_chitin(wavelength_um: float, n: float) -> None:
    """Leertouwer, Wilts and Stavenga 2011 state A, B and the index at three wavelengths."""
    found = dispersion.cauchy(np.array([wavelength_um]), 1.517, [(8.80e-3, -2)])
    assert found == pytest.approx(n, abs=6e-4)


def test_gases_gives_standard_air() -> None:
    """Ciddor 1996 against Edlén 1966 (Metrologia 2, 71): dry air at 15 °C and 1 atm, sodium light."""
    sigma_squared = 0.5893**-2
    edlen = 8342.13e-8 + 2406030e-8 / (130 - sigma_squared) + 15997e-8 / (38.9 - sigma_squared)
    found = dispersion.gases(np.array([0.5893]), 0.0, [(0.05792105, 238.0185), (0.00167917, 57.362)])
    assert found - 1 == pytest.approx(edlen, abs=5e-8)


def test_herzberger_by_hand() -> None:
    """At λ² = 1.028 the pole term is 1: 1 + 2 + 3 + 4·1.028 + 5·1.028² + 6·1.028³ = 21.9143…."""
    wavelength_um = np.sqrt(np.array([1.028]))
    expected = 6 + 4 * 1.028 + 5 * 1.056784 + 6 * 1.086373952
    assert dispersion.herzberger(wavelength_um, 1, 2, 3, 4, 5, 6) == pytest.approx(expected)


def test_retro_by_hand() -> None:
    """At 2 um: 0.1 + 0.1·4/(4 - 2) + 0.05·4 = 1/2 is the Lorentz-Lorenz ratio of n² = 4."""
    assert dispersion.retro(np.array([2.0]), 0.1, 0.1, 2.0, 0.05) == pytest.approx(2.0)


def test_exotic_by_hand() -> None:
    """At 2 um: 2 + 3/(4 - 1) + 12·(2 - 1)/((2 - 1)² + 1) = 9, so n = 3."""
    assert dispersion.exotic(np.array([2.0]), 2.0, 3.0, 1.0, 12.0, 1.0, 1.0) == pytest.approx(3.0)


def test_a_table_is_linear_between_its_points_and_held_beyond() -> None:
    """Halfway between two points lies their mean; outside stands the end value."""
    found = dispersion.tabulated(np.array([0.1, 0.45, 0.9]), [0.4, 0.5], [1.0, 3.0])
    np.testing.assert_allclose(found, [1.0, 2.0, 3.0])


def test_no_real_index_is_nan() -> None:
    """Between a resonance and its zero n² is negative: no real n, and no warning either."""
    assert np.isnan(dispersion.sellmeier_2(np.array([1.0]), 0.0, [(1.0, 1.5)]))
