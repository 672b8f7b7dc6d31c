"""kernels/polynomial_layer.clh: thin layers as polynomials of the angle, against the reference."""

from dataclasses import replace

import numpy as np
import pytest

from kernel_film import largest_error, one_run, plain_problem
from lane_widths import lane_widths
from nacreous.opencl import film_buffers, polynomials
from nacreous.opencl.device import Device
from nacreous.opencl.film import film_intensities
from nacreous.opencl.film_problem import FilmProblem
from nacreous.opencl.layer_polynomials import DEGREES, layer_degree, to_powers
from nacreous.opencl.polynomials import node_mu2, to_chebyshev
from nacreous.opencl.precision import Precision
from reference import film

MU = np.concatenate([[0.0, 1e-6, 1e-3], np.linspace(0.01, 1, 61)])
WAVELENGTH_NM = np.linspace(380, 780, 45)
LAYER_TOLERANCE = 1.5e-6
"""What a layer may add to the error in single precision; waves add as much."""

FILMS = {
    "clear": (1.0, [2.35, 1.46, 2.1, 1.38], [60.0, 95.0, 40.0, 110.0]),
    "metal": (1.0, [1.46, 0.15 + 3.1j, 2.35], [90.0, 8.0, 70.0]),
    "absorbing": (1.0, [2.1 + 0.08j, 1.7 + 0.5j, 4.0 + 0.03j], [45.0, 80.0, 30.0]),
    "gaps of the outside": (1.0, [1.56 + 0.06j, 1.0, 1.56 + 0.06j, 1.0], [90.0, 90.0, 90.0, 90.0]),
    "in water": (1.33, [1.33, 2.4, 1.33 + 1e-4j], [80.0, 50.0, 70.0]),
    "absent": (1.0, [2.0, 1.5], [0.0, 100.0]),
    "twenty": (1.0, [2.3, 1.4] * 10, [55.0, 95.0] * 10),
}


@pytest.fixture(autouse=True)
def small_films_are_polynomials(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let films be as small as tests have them, and none be a polynomial of its own."""
    monkeypatch.setattr(polynomials, "_FEWEST_EVALUATIONS", 0)
    monkeypatch.setattr(film_buffers, "stack_degree", lambda *_: 0)


def thin_film(name: str, factor: float = 1.0) -> FilmProblem:
    """Return one of `FILMS` on glass."""
    incident, layers, d_nm = FILMS[name]
    return one_run(plain_problem([incident, *layers, 1.5], factor * np.array(d_nm), WAVELENGTH_NM, MU))


def tolerance(layers: int) -> float:
    """Error allowed of so many layers: that of five at least."""
    return LAYER_TOLERANCE * max(layers, 5)


@pytest.mark.parametrize("name", FILMS)
@pytest.mark.parametrize(("factor", "degree"), [(1.0, DEGREES[0]), (2.0, DEGREES[1]), (3.0, DEGREES[2])])
def test_thin_films_agree_with_the_reference(name: str, factor: float, degree: int, device: Device) -> None:
    """From grazing to normal incidence, clear, absorbing and metal, as exactly as waves do."""
    problem = thin_film(name, factor)
    assert layer_degree(problem, Precision.SINGLE) == degree
    assert largest_error(device, problem) <= tolerance(len(problem.index) - 2)


@pytest.mark.parametrize("name", ["clear", "metal"])
def test_every_width_of_lanes_agrees(name: str, device: Device) -> None:
    """Coefficients lie in runs as long as the lanes are wide."""
    for lanes in lane_widths(device, Precision.SINGLE):
        assert largest_error(device, thin_film(name), lanes) <= tolerance(5)


def test_random_thin_films_agree_with_the_reference(device: Device) -> None:
    """Up to twelve layers of up to 110 nm, n from 1 to 3.5, k over five decades: every one is polynomials."""
    rng = np.random.default_rng(11)
    for _ in range(40):
        layers = int(rng.integers(1, 13))
        k = np.where(rng.random(layers) < 0.5, 0, 10 ** rng.uniform(-4, 0.5, layers))
        n = [1, *(rng.uniform(1, 3.5, layers) + 1j * k), rng.uniform(1.3, 3) + 0.1j]
        problem = one_run(plain_problem(n, rng.uniform(0.5, 110, layers), WAVELENGTH_NM, MU))
        assert layer_degree(problem, Precision.SINGLE) == DEGREES[0]
        assert largest_error(device, problem) <= tolerance(layers)


@pytest.mark.parametrize("repeat", [2, 9])
@pytest.mark.parametrize("name", ["clear", "gaps of the outside"])
def test_a_group_of_thin_layers_is_its_periods_written_out(name: str, repeat: int, device: Device) -> None:
    """By definition a group stands for its layers, `repeat` times."""
    incident, layers, d_nm = FILMS[name]
    group = [(0, len(layers), repeat)]
    short = plain_problem([incident, *layers, 1.5], d_nm, WAVELENGTH_NM, MU, groups=group)
    assert layer_degree(short, Precision.SINGLE)
    got = film_intensities(device, short, Precision.SINGLE)
    expected = film([incident, *layers * repeat, 1.5], d_nm * repeat, WAVELENGTH_NM, MU)
    for name, values in got.items():
        np.testing.assert_allclose(
            values[0], getattr(expected, name), rtol=0, atol=2 * tolerance(len(layers) * repeat)
        )


def test_every_thickness_has_coefficients_of_its_own(device: Device) -> None:
    """Scales and variants: each row is the film of its thicknesses, and variants are averaged."""
    problem = thin_film("metal")
    d_nm = problem.thickness_nm[0, 0]
    scales, offsets, weights = [0.5, 1.0, 1.3], [-2.0, 3.0], [0.25, 0.75]
    thicknesses = np.array([[scale * d_nm + offset for offset in offsets] for scale in scales])
    got = film_intensities(
        device, replace(problem, thickness_nm=thicknesses, weights=np.array(weights)), Precision.SINGLE
    )
    for row, variants in enumerate(thicknesses):
        films = [film(problem.index, d, problem.wavelength_nm, problem.cos_theta) for d in variants]
        expected = sum(weight * one.R_p for weight, one in zip(weights, films, strict=True))
        np.testing.assert_allclose(got["R_p"][row], expected, rtol=0, atol=tolerance(5))


@pytest.mark.parametrize("degree", DEGREES)
def test_a_cosine_is_interpolated_within_its_bound(degree: int) -> None:
    """cos(sqrt z) on an interval of half width h: h^(D + 1) / ((2 D + 2)! 2^D), nearly reached from 0 on."""
    half_width = {4: 1.69, 6: 7.5, 8: 19.0}[degree]
    mu2, t = node_mu2(degree), np.linspace(-1, 1, 201)
    coefficients = to_powers(degree) @ to_chebyshev(degree) @ np.cos(np.sqrt(2 * half_width * mu2))
    error = np.abs(np.polynomial.polynomial.polyval(t, coefficients) - np.cos(np.sqrt(half_width * (1 + t))))
    assert 2.5e-8 < error.max() < 2.5e-7


@pytest.mark.parametrize(
    ("change", "why"),
    [
        pytest.param({"thickness_nm": np.full((1, 1, 4), 400.0)}, "a phase too large", id="thick"),
        pytest.param({"cos_theta": MU[:20]}, "angles too few to pay", id="few angles"),
        pytest.param({"thickness_nm": np.full((30_000, 1, 4), 90.0)}, "memory", id="many thicknesses"),
    ],
)
def test_waves_do_what_polynomials_cannot(change: dict[str, np.ndarray], why: str) -> None:
    """Where degree, angles or memory speak against it."""
    assert layer_degree(replace(thin_film("clear"), **change), Precision.SINGLE) == 0, why


def test_double_precision_has_waves() -> None:
    """A degree for 53 bits would cost more than a wave."""
    assert layer_degree(thin_film("clear"), Precision.DOUBLE) == 0


def test_a_gap_in_a_dense_medium_has_waves() -> None:
    """A decay of 1.9 at grazing incidence that is nothing at normal incidence would cost digits."""
    problem = one_run(plain_problem([2.0, 1.2 + 2e-3j, 2.0], [75], WAVELENGTH_NM, MU))
    assert layer_degree(problem, Precision.SINGLE) == 0
    assert (
        layer_degree(replace(problem, thickness_nm=problem.thickness_nm / 4), Precision.SINGLE) == DEGREES[0]
    )


def test_a_bare_surface_has_no_polynomials() -> None:
    """There is no layer to take the largest thickness of."""
    assert layer_degree(one_run(plain_problem([1, 1.5], [], WAVELENGTH_NM, MU)), Precision.SINGLE) == 0


def test_little_work_has_waves(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is done in a few milliseconds either way needs no program of its own."""
    monkeypatch.undo()
    film = thin_film("clear")
    finer = np.linspace(0, 1, 1 + 4_000_000 // (4 * WAVELENGTH_NM.size))
    assert layer_degree(film, Precision.SINGLE) == 0
    assert layer_degree(replace(film, cos_theta=finer), Precision.SINGLE) == DEGREES[0]
