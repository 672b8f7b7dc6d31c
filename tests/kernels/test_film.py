"""kernels/film.cl against 60-digit results, other programs and the closed forms of the literature."""

import numpy as np
import pytest
import tmm

from kernel_film import DOUBLE_TOLERANCE, kernel_film, tolerance
from lane_widths import lane_widths
from nacreous.opencl.device import Device
from nacreous.opencl.film import NAMES, film_intensities
from nacreous.opencl.precision import Precision
from nacreous.tables.self_test import golden_errors, goldens
from reference import Intensities

BOTH = pytest.mark.parametrize("precision", list(Precision))
GOLDENS = list(goldens())
KINDS = sorted({golden.kind for golden in GOLDENS})


def close(got: Intensities, R: object, T: object, precision: Precision) -> None:
    """Assert R and T of both polarisations to the precision's tolerance."""
    for name, values in got._asdict().items():
        expected = R if name.startswith("R") else T
        np.testing.assert_allclose(values, expected, rtol=0, atol=tolerance(precision), err_msg=name)


def test_there_are_400_goldens_of_nine_kinds() -> None:
    """Metals, opaque, thick, grazing, totally reflecting stacks …: none may be dropped silently."""
    assert (len(GOLDENS), len(KINDS)) == (400, 9)


@pytest.mark.parametrize("kind", KINDS)
def test_goldens_in_double_precision(kind: str, device: Device) -> None:
    """film_goldens.json was computed with 60 digits; double precision keeps 1e-12."""
    cases = [golden for golden in GOLDENS if golden.kind == kind]
    assert golden_errors(device, cases, Precision.DOUBLE).max() <= DOUBLE_TOLERANCE


def test_goldens_in_single_precision(device: Device) -> None:
    """The same stacks where a table asks for single precision: p99.9 of the error <= 3e-5, all finite."""
    errors = golden_errors(device, GOLDENS, Precision.SINGLE)
    assert np.isfinite(errors).all()
    assert np.quantile(errors, 0.999) <= 3e-5


def test_goldens_left_to_single_precision(device: Device) -> None:
    """Without promotion, too, no golden fails: all finite, half of the errors within 1e-6, the worst 1e-2."""
    computed = [film_intensities(device, golden.problem, Precision.SINGLE) for golden in GOLDENS]
    errors = np.abs([[c[n].item() for n in NAMES] - g.exact for c, g in zip(computed, GOLDENS, strict=True)])
    assert np.quantile(errors, 0.5) <= 1e-6
    assert errors.max() <= 1e-2


@BOTH
def test_the_numbers_of_tmms_own_suite(precision: Precision) -> None:
    """Tmm 0.2, tests.py, `basic_test`: two absorbing layers on an absorbing substrate."""
    got = kernel_film([1, 2 + 4j, 3 + 0.3j, 1 + 0.1j], [2, 3], 100, np.cos(0.1), precision=precision)
    assert got.R_s.item() == pytest.approx(0.37273208839139516, abs=tolerance(precision))
    assert got.R_p.item() == pytest.approx(0.37016110373044969, abs=tolerance(precision))
    assert got.T_s.item() == pytest.approx(0.22604491247079261, abs=tolerance(precision))
    assert got.T_p.item() == pytest.approx(0.22824374314132009, abs=tolerance(precision))


@BOTH
@pytest.mark.parametrize("seed", range(8))
def test_tmm_agrees_on_random_stacks(seed: int, precision: Precision) -> None:
    """The transfer matrices of tmm (Byrnes, arXiv 1603.02720), which are accurate for a few layers."""
    rng = np.random.default_rng(seed)
    layers = int(rng.integers(1, 7))
    k = np.where(rng.random(layers + 1) < 0.4, rng.uniform(0, 4, layers + 1), 0)
    index = [1.2, *(rng.uniform(0.2, 3, layers + 1) + 1j * k)]
    d_nm, mu = rng.uniform(5, 300, layers), rng.uniform(0.05, 1)
    got = kernel_film(index, d_nm, 550, mu, precision=precision)
    for polarisation in "sp":
        expected = tmm.coh_tmm(polarisation, index, [np.inf, *d_nm, np.inf], np.arccos(mu), 550)
        for name in "RT":
            value = getattr(got, f"{name}_{polarisation}").item()
            assert value == pytest.approx(expected[name], abs=tolerance(precision)), name


@BOTH
def test_no_thickness_leaves_the_bare_boundary(precision: Precision) -> None:
    """A layer of thickness 0 is absent: Fresnel's R (Born & Wolf, section 1.5.2), T = 1 - R."""
    mu = np.linspace(0.05, 1, 20)
    inner = np.sqrt(1 - (1 - mu**2) / 1.5**2)
    got = kernel_film([1, 2.4 + 3j, 1.5], [0], 550, mu, precision=precision)
    R_s = ((mu - 1.5 * inner) / (mu + 1.5 * inner)) ** 2
    R_p = ((1.5 * mu - inner) / (1.5 * mu + inner)) ** 2
    np.testing.assert_allclose(got.R_s[:, 0], R_s, rtol=0, atol=tolerance(precision))
    np.testing.assert_allclose(got.R_p[:, 0], R_p, rtol=0, atol=tolerance(precision))
    np.testing.assert_allclose(got.T_s[:, 0], 1 - R_s, rtol=0, atol=tolerance(precision))
    np.testing.assert_allclose(got.T_p[:, 0], 1 - R_p, rtol=0, atol=tolerance(precision))


@BOTH
@pytest.mark.parametrize("orders", [1, 2, 7])
def test_a_half_wave_layer_is_absent(orders: int, precision: Precision) -> None:
    """Born & Wolf, section 1.6.4: n h = m lambda / 2 has no influence: R = ((1 - 1.5) / (1 + 1.5))^2."""
    got = kernel_film([1, 2, 1.5], [orders * 550 / 4], 550, 1, precision=precision)
    close(got, 0.04, 0.96, precision)


@BOTH
@pytest.mark.parametrize(("n_film", "n_substrate"), [(1.38, 1.5), (2.35, 1.52), (1.5, 4.0)])
def test_a_quarter_wave_layer(n_film: float, n_substrate: float, precision: Precision) -> None:
    """Born & Wolf, section 1.6.4: n h = lambda / 4 gives R = ((n_0 n_s - n^2) / (n_0 n_s + n^2))^2."""
    R = ((n_substrate - n_film**2) / (n_substrate + n_film**2)) ** 2
    got = kernel_film([1, n_film, n_substrate], [550 / 4 / n_film], 550, 1, precision=precision)
    close(got, R, 1 - R, precision)


@BOTH
def test_film_of_the_papers_figures(precision: Precision) -> None:
    """Wu & Zheng 2015, figures 3 to 5: between .0400 and .20661, maxima at 4 n d / (2 m + 1)."""
    maxima_nm = 4 * 2.0 * 420 / (2 * np.arange(2, 5) + 1)
    minima_nm = 2 * 2.0 * 420 / np.arange(3, 5)
    highest = ((1.5 - 4) / (1.5 + 4)) ** 2
    close(kernel_film([1, 2, 1.5], [420], maxima_nm, 1, precision=precision), highest, 1 - highest, precision)
    close(kernel_film([1, 2, 1.5], [420], minima_nm, 1, precision=precision), 0.04, 0.96, precision)


@BOTH
def test_brewsters_angle(precision: Precision) -> None:
    """Brewster 1815: no parallel reflection at tan theta = n, for a layer of the substrate's index, too."""
    got = kernel_film([1, 1.5, 1.5], [300], [450, 650], 1 / np.sqrt(1 + 1.5**2), precision=precision)
    np.testing.assert_allclose(got.R_p, 0, atol=tolerance(precision) ** 2 * 100)
    assert got.R_s.min() > 0.1


@BOTH
@pytest.mark.parametrize(
    "index", [[1, 2, 1.5], [1, 0.2 + 3.5j, 1.5], [1, 1.5 + 0.1j, 1], [1.5, 1, 1.5]], ids=str
)
def test_grazing_incidence_reflects_everything(index: list[complex], precision: Precision) -> None:
    """The limit mu = 0 of Fresnel's formulas: R = 1, T = 0 exactly, whatever is below."""
    got = kernel_film(index, [170], [400, 550, 700], 0, precision=precision)
    close(got, 1, 0, precision)
    assert np.all(got.T_s == 0)
    assert np.all(got.T_p == 0)


@BOTH
def test_forty_opaque_layers_equal_one(precision: Precision) -> None:
    """Light that never comes back cannot tell what is behind the first opaque layer."""
    metal, mu = 0.2 + 3.5j, [0, 0.2, 0.7, 1]
    many = kernel_film([1, *[metal, 1.5 + 2j] * 20, 1.5], [5000] * 40, 550, mu, precision=precision)
    one = kernel_film([1, metal, 1.5], [5000], 550, mu, precision=precision)
    half_space = kernel_film([1, metal, metal], [0], 550, mu, precision=precision)
    for got in (many, one):
        np.testing.assert_allclose(got.R_s, half_space.R_s, rtol=0, atol=tolerance(precision))
        np.testing.assert_allclose(got.R_p, half_space.R_p, rtol=0, atol=tolerance(precision))
        np.testing.assert_allclose([got.T_s, got.T_p], 0, atol=1e-30)


@BOTH
@pytest.mark.parametrize("pairs", [4, 32])
def test_a_strong_mirror_written_out(pairs: int, precision: Precision) -> None:
    """Born & Wolf, section 1.6.5: quarter waves of 5 and 0.05 grow a field a hundredfold a pair.

    Their closed form is T = 4 Y / (1 + Y)^2 with the admittance Y = n_s (5 / 0.05)^(2 N), 1e128 for 32 pairs.
    """
    d_nm = [550 / 4 / n for n in (5, 0.05)] * pairs
    got = kernel_film([1, *[5, 0.05] * pairs, 1.5], d_nm, 550, 1, precision=precision)
    admittance = 1.5 * 100.0 ** (2 * pairs)
    close(got, 1, 0, precision)
    assert got.T_s.item() == pytest.approx(4 / admittance, rel=2e-2, abs=1e-30)


@BOTH
@pytest.mark.parametrize(
    ("groups", "coherent"),
    [([], None), ([(0, 2, 5)], [True, True, False])],
    ids=["layers", "a group on a thick layer"],
)
def test_lanes_do_not_matter(
    groups: list[tuple[int, int, int]], coherent: list[bool] | None, precision: Precision, device: Device
) -> None:
    """A wavelength's result does not depend on its neighbours: 21 of them in lanes of 1, 4, 8 and 16."""
    index = [1.3, 1.56 + 0.03j, 1.0, 1.7, 0.9 + 3j]
    arguments = (index, [110, 90, 40], np.linspace(380, 780, 21), np.linspace(0, 1, 7))
    by_width = [
        np.stack(kernel_film(*arguments, groups=groups, coherent=coherent, precision=precision, lanes=lanes))
        for lanes in lane_widths(device, precision)
    ]
    for other in by_width[1:]:
        np.testing.assert_allclose(other, by_width[0], rtol=0, atol=1e-6 * tolerance(precision) / 2e-5)


@BOTH
def test_the_same_call_gives_the_same_bytes(precision: Precision) -> None:
    """A spec's bytes are its identity: a hundred calls of one film with a group are equal."""
    arguments = ([1, 1.56 + 0.06j, 1, 1.5], [90, 110], np.linspace(350, 750, 37), np.linspace(0, 1, 11))
    results = {
        np.stack(kernel_film(*arguments, groups=[(0, 2, 6)], precision=precision)).tobytes()
        for _ in range(100)
    }
    assert len(results) == 1
