"""kernels/period.clh: a group of N equal periods, by repeated squaring."""

import numpy as np
import pytest

from kernel_film import kernel_film, plain_problem, tolerance
from nacreous.opencl.precision import Precision
from nacreous.tables.film import phase_precision
from reference import Film, Groups, Intensities, film

BOTH = pytest.mark.parametrize("precision", list(Precision))
MU = np.array([0.0, 0.15, 0.5, 0.85, 1.0])
WAVELENGTH_NM = np.linspace(380, 780, 41)

PERIODS = {
    "morpho": ([1.56 + 0.06j, 1.0], [100.0, 100.0]),
    "dielectric": ([2.35, 1.38], [56.0, 94.0]),
    "metal": ([1.46, 0.13 + 3.3j], [110.0, 12.0]),
    "three": ([1.7, 1.2 + 0.01j, 2.1], [60.0, 130.0, 45.0]),
}
PERIOD = pytest.mark.parametrize("period", PERIODS)


def stacked(film: Film | Intensities) -> np.ndarray:
    """R_s, R_p, T_s and T_p as (4, A, L)."""
    return np.stack([film.R_s, film.R_p, film.T_s, film.T_p])


@BOTH
@PERIOD
@pytest.mark.parametrize("repeat", [2, 3, 7, 16, 31, 40])
def test_a_group_is_its_periods_written_out(period: str, repeat: int, precision: Precision) -> None:
    """By definition a group stands for its layers, `repeat` times, also between other layers."""
    n, d_nm = PERIODS[period]
    short = kernel_film(
        [1, 1.4, *n, 2.0, 1.5], [90, *d_nm, 60], WAVELENGTH_NM, MU,
        groups=[(1, 1 + len(n), repeat)], precision=precision,
    )  # fmt: skip
    long = kernel_film([1, 1.4, *n * repeat, 2.0, 1.5], [90, *d_nm * repeat, 60], WAVELENGTH_NM, MU)
    allowed = 1e-11 if precision is Precision.DOUBLE else 2e-4 * repeat / 40
    np.testing.assert_allclose(stacked(short), stacked(long), rtol=0, atol=allowed)


@PERIOD
@pytest.mark.parametrize("repeat", [2, 5, 64, 1000])
def test_the_reference_agrees(period: str, repeat: int) -> None:
    """tests/reference.py adds scatterers by doubling, in extended precision."""
    n, d_nm = PERIODS[period]
    groups: Groups = [(0, len(n), repeat)]
    got = kernel_film([1, *n, 1.5], d_nm, WAVELENGTH_NM, MU, groups=groups)
    expected = film([1, *n, 1.5], d_nm, WAVELENGTH_NM, MU, groups=groups)
    np.testing.assert_allclose(stacked(got), stacked(expected), rtol=0, atol=1e-7)


def test_two_groups_agree_with_the_reference() -> None:
    """A stack may have several groups with layers between them."""
    n = [1, 1.4, *PERIODS["dielectric"][0], 1.7, *PERIODS["metal"][0], 1.5]
    d_nm = [70, *PERIODS["dielectric"][1], 30, *PERIODS["metal"][1]]
    groups: Groups = [(1, 3, 9), (4, 6, 4)]
    got = kernel_film(n, d_nm, WAVELENGTH_NM, MU, groups=groups)
    expected = film(n, d_nm, WAVELENGTH_NM, MU, groups=groups)
    np.testing.assert_allclose(stacked(got), stacked(expected), rtol=0, atol=1e-11)


@BOTH
@pytest.mark.parametrize("pairs", [1, 2, 5, 12])
def test_a_quarter_wave_mirror(pairs: int, precision: Precision) -> None:
    """Born & Wolf, section 1.6.5: N pairs of high and low index in quarter waves, a closed form for R."""
    n_high, n_low, n_s = 2.35, 1.38, 1.52
    d_nm = [137.5 / n_high, 137.5 / n_low]
    got = kernel_film([1, n_high, n_low, n_s], d_nm, 550, 1, groups=[(0, 2, pairs)], precision=precision)
    admittance = n_s * (n_high / n_low) ** (2 * pairs)
    expected = ((1 - admittance) / (1 + admittance)) ** 2
    assert got.R_s.item() == pytest.approx(expected, abs=tolerance(precision))


def tabulated(
    n: list[complex], d_nm: list[float], mu: np.ndarray, repeat: int, asked: Precision
) -> np.ndarray:
    """Periods on glass in the precision that a table of them has, (4, A, L)."""
    groups: Groups = [(0, len(n), repeat)]
    precision = phase_precision(plain_problem([1, *n, 1.5], d_nm, WAVELENGTH_NM, mu, groups=groups), asked)
    got = kernel_film([1, *n, 1.5], d_nm, WAVELENGTH_NM, mu, groups=groups, precision=precision)
    return stacked(got)


@BOTH
@pytest.mark.parametrize("repeat", [1_000, 1_000_000])
@pytest.mark.parametrize("period", ["morpho", "three"])
def test_many_absorbing_periods_are_a_half_space(period: str, repeat: int, precision: Precision) -> None:
    """Where a period absorbs, the far end is out of reach: R is that of 4,096 periods on a metal, T is 0."""
    n, d_nm = PERIODS[period]
    got = tabulated(n, d_nm, MU[1:], repeat, precision)
    limit = film([1, *n, 0.3 + 5j], d_nm, WAVELENGTH_NM, MU[1:], groups=[(0, len(n), 4096)])
    np.testing.assert_allclose(got[0], limit.R_s, rtol=0, atol=1e-7)
    np.testing.assert_allclose(got[1], limit.R_p, rtol=0, atol=1e-7)
    assert got[2:].max() <= 1e-6


@BOTH
@pytest.mark.parametrize("repeat", [1_000, 1_000_000])
def test_many_lossless_periods_keep_energy(repeat: int, precision: Precision) -> None:
    """R + T = 1 after a million periods: the errors of twenty squarings stay small, in stop bands, too."""
    got = tabulated(*PERIODS["dielectric"], MU, repeat, precision)
    np.testing.assert_allclose(got[:2] + got[2:], 1, rtol=0, atol=1e-8)


@pytest.mark.parametrize("period", PERIODS)
def test_single_precision_stays_finite(period: str) -> None:
    """A million periods left to single precision decay by 1e-100,000 and more, and stay numbers."""
    n, d_nm = PERIODS[period]
    groups: Groups = [(0, len(n), 1_000_000)]
    got = kernel_film([1, *n, 1.5], d_nm, WAVELENGTH_NM, MU, groups=groups, precision=Precision.SINGLE)
    assert np.isfinite(stacked(got)).all()
    assert stacked(got).min() >= 0
