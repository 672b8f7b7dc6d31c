"""kernels/incoherent.clh: thick layers, across which intensities add (Byrnes, arXiv 1603.02720, 6)."""

import itertools

import numpy as np
import pytest
import tmm

from kernel_film import kernel_film, tolerance
from nacreous.opencl.precision import Precision
from reference import incoherent_film

BOTH = pytest.mark.parametrize("precision", list(Precision))
MU = np.array([0.0, 0.02, 0.3, 0.8, 1.0])
PATTERNS = [pattern for pattern in itertools.product([True, False], repeat=4) if not all(pattern)]
WAVELENGTH_NM = np.array([400.0, 480.0, 550.0, 700.0])


@BOTH
@pytest.mark.parametrize("cos_theta", [1.0, 0.8, 0.3])
@pytest.mark.parametrize("pattern", ["icc", "cic", "cci", "iic", "cii", "ici", "iii"])
def test_tmm_agrees(pattern: str, cos_theta: float, precision: Precision) -> None:
    """The inc_tmm of tmm with thick layers first, last, in the middle and side by side."""
    index, d_nm = [1.0, 2.0, 1.5 + 1e-4j, 1.7 + 1e-3j, 1.6], [120.0, 9000.0, 15000.0]
    got = kernel_film(index, d_nm, 550, cos_theta, coherent=[c == "c" for c in pattern], precision=precision)
    for polarisation in "sp":
        expected = tmm.inc_tmm(
            polarisation, index, [np.inf, *d_nm, np.inf], ["i", *pattern, "i"], np.arccos(cos_theta), 550
        )
        for name in "RT":
            value = getattr(got, f"{name}_{polarisation}").item()
            assert value == pytest.approx(expected[name], abs=tolerance(precision)), name


@BOTH
@pytest.mark.parametrize("pattern", PATTERNS, ids=str)
def test_the_reference_agrees(pattern: tuple[bool, ...], precision: Precision) -> None:
    """tests/reference.py composes intensities in extended precision; every pattern of four layers."""
    index, d_nm = [1.2, 2.1, 1.5 + 1e-5j, 1.05, 1.8 + 0.002j, 1.6], [150.0, 2e4, 300.0, 800.0]
    got = kernel_film(index, d_nm, WAVELENGTH_NM, MU, coherent=pattern, precision=precision)
    expected = incoherent_film(index, d_nm, WAVELENGTH_NM, MU, coherent=pattern)
    allowed = 10 * tolerance(precision)
    np.testing.assert_allclose(np.stack(got), np.stack(expected), rtol=0, atol=allowed)


@BOTH
def test_a_group_upon_a_thick_layer(precision: Precision) -> None:
    """A periodic mirror on a millimetre of glass: groups and thick layers in one stack."""
    index, d_nm = [1, 2.35, 1.38, 1.52 + 1e-8j, 1], [58.0, 100.0, 1e6]
    kinds = {"coherent": [True, True, False], "groups": [(0, 2, 6)]}
    got = kernel_film(index, d_nm, WAVELENGTH_NM, MU, precision=precision, **kinds)
    expected = incoherent_film(index, d_nm, WAVELENGTH_NM, MU, **kinds)
    np.testing.assert_allclose(np.stack(got), np.stack(expected), rtol=0, atol=10 * tolerance(precision))


@BOTH
@pytest.mark.parametrize("index", [0.05 + 3j, 1.0, 1.3 + 0.02j])
def test_a_decay_is_not_a_wave(index: complex, precision: Precision) -> None:
    """Intensities that decay without a flux do not add: R stays a ratio, and T is 0, however thin the layer.

    (The rule of Byrnes, section 6, gives R = 10 for 15 nm of a metal that is called incoherent.)
    """
    stack, d_nm, mu = [1.8, 2.4, index, 1.6], [90, 15], [0.2, 0.4]
    got = kernel_film(stack, d_nm, 550, mu, coherent=[True, False], precision=precision)
    assert max(got.R_s.max(), got.R_p.max()) <= 1 + tolerance(precision)
    np.testing.assert_array_equal([got.T_s, got.T_p], 0)


@BOTH
def test_a_wave_that_is_evanescent_in_a_thick_layer(precision: Precision) -> None:
    """Total reflection into a layer that is thick against the decay: nothing reaches what is behind it."""
    got = kernel_film([1.5, 1.0, 1.5], [1e5], 550, [0.1, 0.3, 0.7], coherent=[False], precision=precision)
    np.testing.assert_allclose([got.R_s, got.R_p], 1, rtol=0, atol=tolerance(precision))
    np.testing.assert_allclose([got.T_s, got.T_p], 0, rtol=0, atol=1e-30)


@BOTH
@pytest.mark.parametrize("plates", [1, 2, 5])
def test_a_pile_of_plates(plates: int, precision: Precision) -> None:
    """Stokes 1862: m thick plates in air reflect 2 m rho / (1 + (2 m - 1) rho), rho of one boundary."""
    mu, n = 0.6, 1.5
    inner = np.sqrt(1 - (1 - mu**2) / n**2)
    count = 2 * plates - 1
    pile, thick = [1, *[n, 1.0] * plates], [False] * count
    got = kernel_film(pile, [1e6] * count, 550, mu, coherent=thick, precision=precision)
    for rho, R, T in (
        (((mu - n * inner) / (mu + n * inner)) ** 2, got.R_s, got.T_s),
        (((n * mu - inner) / (n * mu + inner)) ** 2, got.R_p, got.T_p),
    ):
        expected = 2 * plates * rho / (1 + (2 * plates - 1) * rho)
        assert R.item() == pytest.approx(expected, abs=tolerance(precision))
        assert T.item() == pytest.approx(1 - expected, abs=tolerance(precision))


@BOTH
def test_a_window_without_loss_keeps_energy(precision: Precision) -> None:
    """R + T = 1 for a coated window at every angle, grazing incidence included, where R = 1."""
    mu = np.linspace(0, 1, 101)
    got = kernel_film(
        [1, 1.38, 1.52, 1.38, 1], [100, 1e6, 100], WAVELENGTH_NM, mu,
        coherent=[True, False, True], precision=precision,
    )  # fmt: skip
    np.testing.assert_allclose(got.R_s + got.T_s, 1, rtol=0, atol=tolerance(precision))
    np.testing.assert_allclose(got.R_p + got.T_p, 1, rtol=0, atol=tolerance(precision))
    np.testing.assert_allclose(got.R_s[0], 1, rtol=0, atol=tolerance(precision))


def test_a_thick_layer_is_the_mean_over_its_fringes() -> None:
    """Born & Wolf, section 7.6: the mean of Airy's formula over a whole fringe is the sum of intensities."""
    index, half_wave_nm = [1, 2.0, 1.5], 550 / 4
    steps = np.arange(200) / 200
    fringe = [kernel_film(index, [20 * half_wave_nm + half_wave_nm * s], 550, 1).R_s.item() for s in steps]
    thick = kernel_film(index, [20 * half_wave_nm], 550, 1, coherent=[False]).R_s.item()
    assert np.mean(fringe) == pytest.approx(thick, abs=1e-12)
