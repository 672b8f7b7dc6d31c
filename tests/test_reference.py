"""The reference film against 60-digit results, other programs and closed forms of the literature."""

import itertools
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tmm

import reference_paper as paper
from reference import film, incoherent_film, spread_film

GOLDENS = Path(__file__).parents[1] / "service/nacreous/opencl/film_goldens.json"
INTENSITIES = ("R_s", "R_p", "T_s", "T_p")


def golden_cases() -> list[dict[str, Any]]:
    """Read the 400 stacks that were computed with 60 digits."""
    cases: list[dict[str, Any]] = json.loads(GOLDENS.read_text())["cases"]
    return cases


def random_stacks(count: int) -> list[tuple[list[complex], list[float], float]]:
    """Make stacks of one to five layers, two in five of them absorbing: (index, thickness_nm, cos_theta)."""
    rng = np.random.default_rng(20150311)
    stacks = []
    for layers in rng.integers(1, 6, count):
        k = np.where(rng.random(layers) < 0.4, rng.uniform(0, 4, layers), 0)
        index = [1.0, *(rng.uniform(0.2, 3, layers) + 1j * k), 1.5]
        stacks.append((index, list(rng.uniform(5, 400, layers)), float(rng.uniform(0.05, 1))))
    return stacks


@pytest.mark.parametrize("kind", sorted({case["kind"] for case in golden_cases()}))
def test_goldens_hold_to_1e_12(kind: str) -> None:
    """The recursion in 60 digits gave film_goldens.json; double precision leaves 1e-12."""
    for case in (c for c in golden_cases() if c["kind"] == kind):
        index = [complex(*n) for n in case["n"]]
        got = film(index, case["d_nm"], case["wavelength_nm"], case["cos_theta"])
        for name in INTENSITIES:
            assert getattr(got, name).item() == pytest.approx(case[name], rel=1e-12, abs=1e-12), (name, case)


def test_the_numbers_of_tmms_own_suite() -> None:
    """Tmm 0.2, tests.py, `basic_test`: two absorbing layers on an absorbing substrate."""
    got = film([1, 2 + 4j, 3 + 0.3j, 1 + 0.1j], [2, 3], 100, np.cos(0.1))
    assert got.R_s.item() == pytest.approx(0.37273208839139516, rel=1e-12)
    assert got.R_p.item() == pytest.approx(0.37016110373044969, rel=1e-12)
    assert got.T_s.item() == pytest.approx(0.22604491247079261, rel=1e-12)
    assert got.T_p.item() == pytest.approx(0.22824374314132009, rel=1e-12)
    assert got.psi.item() == pytest.approx(0.78366777347038352, rel=1e-12)
    assert got.Delta.item() == pytest.approx(0.0021460774404193292, rel=1e-9)


@pytest.mark.parametrize(("index", "thickness_nm", "cos_theta"), random_stacks(40))
def test_tmm_gives_the_same_amplitudes(
    index: list[complex], thickness_nm: list[float], cos_theta: float
) -> None:
    """The transfer matrices of tmm (Byrnes 2016) agree in amplitude, phase and flux."""
    got = film(index, thickness_nm, 550, cos_theta)
    for polarisation in "sp":
        expected = tmm.coh_tmm(
            polarisation, index, [np.inf, *thickness_nm, np.inf], np.arccos(cos_theta), 550
        )
        for name in "rtRT":
            value = getattr(got, f"{name}_{polarisation}").item()
            assert value == pytest.approx(expected[name], rel=1e-9, abs=1e-11), name


@pytest.mark.parametrize(("index", "thickness_nm", "cos_theta"), random_stacks(40))
def test_pymoosh_gives_the_same_intensities(
    index: list[complex], thickness_nm: list[float], cos_theta: float
) -> None:
    """PyMoosh's scattering matrices agree; its own interface works with permittivities."""
    from PyMoosh import Structure, coefficient_S

    structure = Structure(
        [complex(n) ** 2 for n in index], list(range(len(index))), [0.0, *thickness_nm, 0.0], verbose=False
    )
    got = film(index, thickness_nm, 550, cos_theta)
    for number, polarisation in enumerate("sp"):
        R, T = coefficient_S(structure, 550.0, np.arccos(cos_theta), number)[2:]
        assert getattr(got, f"R_{polarisation}").item() == pytest.approx(R, abs=1e-11)
        assert getattr(got, f"T_{polarisation}").item() == pytest.approx(T, abs=1e-11)


def test_a_layer_at_its_critical_angle() -> None:
    """1.5 / 1.2 / 1.5 at mu = 0.6: beta = n_1, where the field in the film is a straight line."""
    got = film([1.5, 1.2, 1.5], [500], 550, 0.6)
    assert got.R_s.item() == pytest.approx(0.868541, abs=1e-6)
    assert got.R_p.item() == pytest.approx(0.730182, abs=1e-6)
    assert got.R_s.item() + got.T_s.item() == pytest.approx(1, abs=1e-11)


def test_kz_of_exactly_zero_is_the_limit_of_its_neighbours() -> None:
    """Reflectance is continuous through a critical angle, where n_1 = beta."""
    mu = np.longdouble(0.6)
    beta = 1.25 * np.sqrt((1 - mu) * (1 + mu))
    at, near = (film(np.array([1.25, n, 1.5]), [300], 550, mu) for n in (beta, beta + 1e-11))
    assert at.R_s.item() == pytest.approx(near.R_s.item(), abs=1e-9)
    assert at.T_p.item() == pytest.approx(near.T_p.item(), abs=1e-9)


@pytest.mark.parametrize("n_layer", [1.0, 1.33, 0.2 + 3j])
def test_grazing_incidence_reflects_everything(n_layer: complex) -> None:
    """Equation 10 tends to r = -1 for s and p as cos theta_0 goes to 0, even where the film is of air."""
    got = film([1, n_layer, 1.5], [200], 550, [0.0, 0.5])
    assert [got.R_s[0, 0], got.R_p[0, 0], got.T_s[0, 0], got.T_p[0, 0]] == [1, 1, 0, 0]
    thick = incoherent_film([1, n_layer, 1.5], [200], 550, [0.0, 0.5], coherent=[False])
    assert [i[0, 0] for i in thick] == [1, 1, 0, 0]


def test_no_thickness_leaves_the_bare_boundary() -> None:
    """A layer of thickness 0 is absent: R = ((n_0 - n_s) / (n_0 + n_s))^2 at normal incidence (Fresnel)."""
    assert film([1, 2.4 + 1j, 1.5], [0], 550, 1).R_s.item() == pytest.approx(0.04, abs=1e-15)


def test_a_half_wave_layer_is_absent() -> None:
    """Born & Wolf, section 1.6.4: n h = lambda / 2 has no influence on R."""
    assert film([1, 2, 1.5], [550 / 4], 550, 1).R_p.item() == pytest.approx(0.04, abs=1e-15)


def test_a_quarter_wave_layer() -> None:
    """Born & Wolf, section 1.6.4: n h = lambda / 4 gives R = ((n_0 n_s - n_1^2) / (n_0 n_s + n_1^2))^2."""
    expected = ((1.5 - 1.38**2) / (1.5 + 1.38**2)) ** 2
    assert film([1, 1.38, 1.5], [550 / 4 / 1.38], 550, 1).R_s.item() == pytest.approx(expected, abs=1e-15)


@pytest.mark.parametrize("repeat", [1, 2, 5, 12])
def test_a_quarter_wave_mirror(repeat: int) -> None:
    """Born & Wolf, section 1.6.5: N pairs of high and low index in quarter waves, a closed form for R."""
    n_high, n_low, n_s = 2.35, 1.38, 1.52
    got = film([1, n_high, n_low, n_s], [137.5 / n_high, 137.5 / n_low], 550, 1, groups=[(0, 2, repeat)])
    admittance = n_s * (n_high / n_low) ** (2 * repeat)
    assert got.R_s.item() == pytest.approx(((1 - admittance) / (1 + admittance)) ** 2, abs=1e-14)


@pytest.mark.parametrize("repeat", [1, 2, 7, 1000])
def test_a_group_is_its_periods_written_out(repeat: int) -> None:
    """By definition a group stands for its layers, `repeat` times, also between other layers."""
    pair = [1.56 + 0.001j, 1.0]
    short = film([1, 1.4, *pair, 2.0, 1.5], [90, 80, 110, 60], 480, [0.3, 0.9], groups=[(1, 3, repeat)])
    long = film([1, 1.4, *pair * repeat, 2.0, 1.5], [90, *[80, 110] * repeat, 60], 480, [0.3, 0.9])
    for short_value, long_value in zip(short, long, strict=True):
        np.testing.assert_allclose(short_value, long_value, rtol=0, atol=1e-13)


def test_forty_opaque_layers_equal_one() -> None:
    """Light that never comes back cannot tell what is behind the first opaque layer."""
    metal = 0.2 + 3.5j
    many = film([1, *[metal, 1.5 + 2j] * 20, 1.5], [5000] * 40, 550, [0.2, 0.7, 1])
    one = film([1, metal, 1.5], [5000], 550, [0.2, 0.7, 1])
    np.testing.assert_allclose(many.R_p, one.R_p, rtol=0, atol=1e-15)
    assert np.all(many.T_s == 0)


def test_wavelengths_and_angles_broadcast() -> None:
    """A table is its single values side by side, (A, L), with an index for each wavelength."""
    index = np.array([[1, 1], [2 + 1j, 2.2], [1.5, 1.6]])
    table = film(index, [120], [450, 650], [0.2, 0.5, 0.9])
    assert table.R_s.shape == (3, 2)
    single = film(index[:, 1], [120], 650, 0.5)
    assert [v.item() for v in single] == [v[1, 1] for v in table]


FILMS = [
    pytest.param((1.0, 2.0, 1.5), 420.0, 0.7, id="dielectric"),
    pytest.param((1.0, 0.6 + 3j, 1.5), 30.0, 0.7, id="absorbing"),
    pytest.param((1.5, 1.2, 1.5), 200.0, 0.3, id="evanescent"),
    pytest.param((1.0, 2.4, 0.6 + 3j), 60.0, 0.5, id="on metal"),
]
CORRECTED = [
    pytest.param(paper.equation_2, "r", id="equation 2"),
    pytest.param(paper.equation_3, "t", id="equation 3"),
    pytest.param(paper.equation_7, "R", id="equation 7"),
    pytest.param(paper.equation_8, "T", id="equation 8"),
]


@pytest.mark.parametrize(("index", "thickness_nm", "cos_theta"), FILMS)
@pytest.mark.parametrize(("equation", "name"), CORRECTED)
def test_the_papers_equations_corrected(
    equation: Callable[[paper.SingleFilm], paper.Complex],
    name: str,
    index: tuple[complex, complex, complex],
    thickness_nm: float,
    cos_theta: float,
) -> None:
    """Wu & Zheng 2015, equations 2, 3, 7, 8 for one film, s and p apart, with their errata corrected."""
    wavelength_nm = np.linspace(350, 750, 5)
    got = film(index, [thickness_nm], wavelength_nm, cos_theta)
    for polarisation, single in zip(
        "sp", paper.single_film(index, thickness_nm, wavelength_nm, cos_theta), strict=True
    ):
        expected = equation(single)
        np.testing.assert_allclose(getattr(got, f"{name}_{polarisation}")[0], expected, rtol=0, atol=1e-13)


def test_equation_7_as_printed_holds_for_real_coefficients_alone() -> None:
    """Squares are squared moduli for a dielectric film; on metal the printed equation is off by over 0.1."""
    wavelength_nm = np.linspace(350, 750, 9)
    errors = []
    for index in ((1, 2.0, 1.5), (1, 2.4, 0.6 + 3j)):
        single = paper.single_film(index, 200, wavelength_nm, 0.5)[0]
        errors.append(
            np.abs(paper.equation_7_printed(single) - film(index, [200], wavelength_nm, 0.5).R_s).max()
        )
    assert errors[0] < 1e-14
    assert errors[1] > 0.1


@pytest.mark.parametrize(("cos_theta", "smallest_error"), [(1.0, 0.0), (0.5, 0.05)])
def test_equation_8_as_printed_holds_at_normal_incidence_alone(
    cos_theta: float, smallest_error: float
) -> None:
    """The film's angle in place of the substrate's: no difference at mu = 1, above 5 % at 60 degrees."""
    single = paper.single_film((1, 2.0, 1.5), 420, np.array([550.0]), cos_theta)[0]
    ratio = paper.equation_8_printed(single).real / film((1, 2.0, 1.5), [420], 550, cos_theta).T_s
    assert abs(ratio.item() - 1) == pytest.approx(0, abs=1e-14) if smallest_error == 0 else smallest_error
    assert abs(ratio.item() - 1) >= smallest_error


def test_equation_3_as_printed_breaks_energy() -> None:
    """t_1 + t_2 of two boundaries of a soap film transmits more than came in; t_1 t_2 gives R + T = 1."""
    single = paper.single_film((1, 1.33, 1), 300, np.array([550.0]), 1.0)[0]
    reflected = np.abs(paper.equation_2(single)) ** 2
    assert np.abs(paper.equation_3(single)) ** 2 + reflected == pytest.approx(1, abs=1e-14)
    assert np.abs(paper.equation_3_printed(single)) ** 2 + reflected > 3


@pytest.mark.parametrize("plates", [1, 2, 5])
def test_a_pile_of_plates(plates: int) -> None:
    """Stokes 1862: m thick plates in air reflect 2 m rho / (1 + (2 m - 1) rho), rho of one boundary."""
    rho = film([1, 1.5], [], 550, 0.6)
    media, count = [*[1.5, 1.0] * plates][:-1], 2 * plates - 1
    got = incoherent_film([1, *media, 1], [1e6] * count, 550, 0.6, coherent=[False] * count)
    for reflected, single in ((got.R_s, rho.R_s), (got.R_p, rho.R_p)):
        expected = 2 * plates * single / (1 + (2 * plates - 1) * single)
        np.testing.assert_allclose(reflected, expected, rtol=1e-13)


@pytest.mark.parametrize("cos_theta", [1.0, 0.8, 0.3])
@pytest.mark.parametrize("pattern", list(itertools.product("ic", repeat=3)))
def test_incoherent_layers_agree_with_tmm(pattern: tuple[str, ...], cos_theta: float) -> None:
    """The inc_tmm of tmm (Byrnes 2016, section 6) for every mixture of thick and thin layers."""
    index, thickness_nm = [1.0, 2.0, 1.5 + 1e-4j, 0.3 + 2j, 1.6], [120.0, 900.0, 15.0]
    got = incoherent_film(index, thickness_nm, 550, cos_theta, coherent=[c == "c" for c in pattern])
    for polarisation in "sp":
        expected = tmm.inc_tmm(
            polarisation,
            index,
            [np.inf, *thickness_nm, np.inf],
            ["i", *pattern, "i"],
            np.arccos(cos_theta),
            550,
        )
        assert getattr(got, f"R_{polarisation}").item() == pytest.approx(expected["R"], rel=1e-9)
        assert getattr(got, f"T_{polarisation}").item() == pytest.approx(expected["T"], rel=1e-9)


def test_a_thick_evanescent_layer_reflects_everything() -> None:
    """Total reflection into a layer that is thick against the decay: nothing reaches what is behind it."""
    got = incoherent_film([1.5, 1.0, 1.5], [1e5], 550, 0.3, coherent=[False])
    assert [got.R_s.item(), got.T_p.item()] == pytest.approx([1, 0], abs=1e-15)


def test_a_wide_spread_of_thickness_is_an_incoherent_layer() -> None:
    """Averaged over many fringes, the square of a sum of amplitudes is the sum of intensities."""
    index, mu = [1, 2.0, 1.5], [0.4, 1.0]
    spread, thick = (
        spread_film(index, [20000], [1000], 550, mu),
        incoherent_film(index, [20000], 550, mu, coherent=[False]),
    )
    for average, expected in zip(spread, thick, strict=True):
        np.testing.assert_allclose(average, expected, rtol=0, atol=1e-12)


def test_a_narrow_spread_adds_half_the_curvature() -> None:
    """Taylor: the mean of R over a normal distribution is R + sigma^2 R'' / 2 + sigma^4 R'''' / 8."""
    index, step_nm, sigma_nm = [1, 2.0, 1.5], 1.0, 2.0
    R = [film(index, [420 + i * step_nm], 550, 1).R_s.item() for i in (-1, 0, 1)]
    curvature = (R[0] - 2 * R[1] + R[2]) / step_nm**2
    got = spread_film(index, [420], [sigma_nm], 550, 1).R_s.item()
    assert got - R[1] == pytest.approx(sigma_nm**2 / 2 * curvature, rel=0.02)


def test_spreads_of_two_layers_are_independent() -> None:
    """Fubini: the average over both is the average over one of the averages over the other."""
    index, d_nm = [1, 2.0, 1.4, 1.5], [200.0, 150.0]
    both = np.stack(spread_film(index, d_nm, [20, 15], 550, 0.8))
    inner = [
        np.stack(spread_film(index, [200 + 20 * z, 150], [0, 15], 550, 0.8)) for z in np.linspace(-6, 6, 61)
    ]
    weight = np.exp(-(np.linspace(-6, 6, 61) ** 2) / 2)
    np.testing.assert_allclose(both, np.tensordot(weight / weight.sum(), inner, 1), rtol=0, atol=1e-7)


@pytest.mark.parametrize(("index", "thickness_nm", "cos_theta"), random_stacks(20))
def test_no_film_creates_energy(index: list[complex], thickness_nm: list[float], cos_theta: float) -> None:
    """R + T <= 1, and = 1 where nothing absorbs."""
    got = film(index, thickness_nm, 550, cos_theta)
    clear = film(np.real(index), thickness_nm, 550, cos_theta)
    assert max(got.R_s + got.T_s, got.R_p + got.T_p) <= 1 + 1e-14
    assert [(clear.R_s + clear.T_s).item(), (clear.R_p + clear.T_p).item()] == pytest.approx(
        [1, 1], abs=1e-13
    )


def test_the_average_keeps_its_names() -> None:
    """Every intensity of `spread_film` with no spread is that of `film`."""
    got, expected = spread_film([1, 2, 1.5], [420], [0], 550, 0.5), film([1, 2, 1.5], [420], 550, 0.5)
    for name in INTENSITIES:
        assert getattr(got, name) == pytest.approx(getattr(expected, name), abs=1e-15)
