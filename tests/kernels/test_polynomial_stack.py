"""kernels/polynomial_stack.clh: whole stacks as polynomials of the angle, against the reference."""

from dataclasses import replace

import numpy as np
import pytest

from kernel_film import largest_error, one_run, plain_problem
from lane_widths import lane_widths
from nacreous.opencl import polynomials, stack_polynomials
from nacreous.opencl.device import Device
from nacreous.opencl.film import film_intensities
from nacreous.opencl.film_buffers import film_buffers
from nacreous.opencl.film_colour import Side, film_colours
from nacreous.opencl.film_ellipsometry import film_ellipsometry
from nacreous.opencl.film_problem import FilmProblem
from nacreous.opencl.polynomials import Form
from nacreous.opencl.precision import Precision
from nacreous.opencl.stack_polynomials import DEGREES, stack_degree
from reference import film

MU = np.concatenate([[0.0, 1e-6, 1e-3, 0.02, 0.05], np.linspace(0.07, 1, 59)])
WAVELENGTH_NM = np.linspace(380, 780, 45)
TOLERANCE = 8e-6
"""Half of what single precision may be off; waves of so many layers need as much."""

FILMS = {
    "clear": (1.0, [2.35, 1.46, 2.1, 1.38], [60.0, 95.0, 40.0, 110.0], 1.5),
    "metal": (1.0, [1.46, 0.15 + 3.1j, 2.35], [90.0, 8.0, 70.0], 1.5),
    "absorbing": (1.0, [2.1 + 0.08j, 1.7 + 0.5j, 4.0 + 0.03j], [45.0, 80.0, 30.0], 1.5),
    "on metal": (1.0, [1.46, 2.2], [120.0, 60.0], 0.6 + 4.5j),
    "in water": (1.33, [1.33, 2.4, 1.33 + 1e-4j], [80.0, 50.0, 70.0], 1.52),
    "into air": (1.5, [2.1, 1.7], [80.0, 60.0], 1.0),
    "a gap": (1.5, [1.0 + 0j, 1.9], [60.0, 90.0], 1.6),
    "weak": (1.0, [1.35, 1.3] * 3, [70.0, 90.0] * 3, 1.3),
    "twenty": (1.0, [1.9, 1.6] * 10, [25.0, 45.0] * 10, 1.5),
}


@pytest.fixture(autouse=True)
def small_films_are_polynomials(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let films be as small as tests have them."""
    monkeypatch.setattr(polynomials, "_FEWEST_EVALUATIONS", 0)
    monkeypatch.setattr(stack_polynomials, "_pays", lambda *_: True)


def stack(name: str, factor: float = 1.0) -> FilmProblem:
    """Return one of `FILMS`, so many times as thick."""
    incident, layers, d_nm, substrate = FILMS[name]
    return one_run(plain_problem([incident, *layers, substrate], factor * np.array(d_nm), WAVELENGTH_NM, MU))


def form_of(device: Device, problem: FilmProblem) -> Form:
    """Return what the kernels evaluate a film by."""
    buffers = film_buffers(device, problem, Precision.SINGLE, device.lanes(Precision.SINGLE))
    return Form(dict(buffers.build_numbers)["POLYNOMIALS"])


@pytest.mark.parametrize("name", FILMS)
@pytest.mark.parametrize("factor", [0.5, 1.0, 1.4])
def test_stacks_agree_with_the_reference(name: str, factor: float, device: Device) -> None:
    """From grazing to normal incidence; clear, absorbing, metal, and beyond a critical angle."""
    assert largest_error(device, stack(name, factor)) <= TOLERANCE


@pytest.mark.parametrize("name", FILMS)
def test_these_stacks_are_polynomials(name: str, device: Device) -> None:
    """The tests of this file are not of layers."""
    assert form_of(device, stack(name)) is Form.OF_STACK


@pytest.mark.parametrize("degree", DEGREES)
def test_every_degree_serves_some_thickness(degree: int, device: Device) -> None:
    """The first degree that is exact is taken, and at the thickest film of it, it is."""
    films = [stack("weak", factor) for factor in np.geomspace(0.2, 8, 60)]
    thickest = [film for film in films if stack_degree(film, Precision.SINGLE) == degree][-1]
    assert form_of(device, thickest) is Form.OF_STACK
    assert largest_error(device, thickest) <= TOLERANCE


@pytest.mark.parametrize("name", ["clear", "metal"])
def test_every_width_of_lanes_agrees(name: str, device: Device) -> None:
    """Coefficients lie in runs as long as the lanes are wide."""
    for lanes in lane_widths(device, Precision.SINGLE):
        assert largest_error(device, stack(name), lanes) <= TOLERANCE


def test_random_stacks_agree_with_the_reference(device: Device) -> None:
    """Up to twelve layers of all kinds: those that lose digits as one polynomial are none."""
    rng = np.random.default_rng(11)
    forms = []
    for _ in range(60):
        layers = int(rng.integers(1, 13))
        k = np.where(rng.random(layers) < 0.5, 0, 10 ** rng.uniform(-4, 0.5, layers))
        n = [1, *(rng.uniform(1, 3.5, layers) + 1j * k), rng.uniform(1.3, 3) + 0.1j]
        problem = one_run(plain_problem(n, rng.uniform(0.5, 110, layers), WAVELENGTH_NM, MU))
        forms.append(form_of(device, problem))
        assert largest_error(device, problem) <= 2 * TOLERANCE
    assert forms.count(Form.OF_STACK) > len(forms) / 2


def test_a_cavity_keeps_its_layers(device: Device) -> None:
    """Between mirrors the fields of a resonance are small beside those about it: digits would be lost."""
    mirror = [2.4, 1.4, 2.4, 1.4, 2.4]
    d_nm = [57.0, 98.0, 57.0, 98.0, 57.0]
    n = [1.0, *mirror, 1.4, *mirror, 1.5]
    problem = one_run(plain_problem(n, [*d_nm, 196.0, *d_nm], WAVELENGTH_NM, MU))
    assert stack_degree(problem, Precision.SINGLE)
    assert form_of(device, problem) is Form.OF_LAYERS
    assert largest_error(device, problem) <= 2 * TOLERANCE


def test_a_field_that_is_least_at_grazing_incidence_is_looked_at_there(device: Device) -> None:
    """On metal H of p falls within the last degrees, short of the first probe between nodes."""
    problem = one_run(plain_problem([1.0, 1.5, 0.25 + 8.1j], [80.0], np.linspace(350, 400, 16), MU))
    assert stack_degree(problem, Precision.SINGLE)
    assert form_of(device, problem) is Form.OF_LAYERS


def test_a_field_that_leaves_the_range_keeps_its_layers(device: Device) -> None:
    """18 quarter-wave pairs of index 400 and 1 grow a field to 1e46: coefficients are no numbers."""
    n, d_nm = [1.0, *[400.0, 1.0] * 18, 1.5], [0.3, 60.0] * 18
    problem = one_run(plain_problem(n, d_nm, WAVELENGTH_NM, MU))
    assert stack_degree(problem, Precision.SINGLE)
    assert form_of(device, problem) is Form.OF_LAYERS


def test_every_thickness_has_coefficients_of_its_own(device: Device) -> None:
    """Scales and variants: each row is the film of its thicknesses, and variants are averaged."""
    problem = stack("metal")
    d_nm = problem.thickness_nm[0, 0]
    scales, offsets, weights = [0.5, 1.0, 1.3], [-2.0, 3.0], [0.25, 0.75]
    thicknesses = np.array([[scale * d_nm + offset for offset in offsets] for scale in scales])
    varied = replace(problem, thickness_nm=thicknesses, weights=np.array(weights))
    assert form_of(device, varied) is Form.OF_STACK
    got = film_intensities(device, varied, Precision.SINGLE)
    for row, variants in enumerate(thicknesses):
        films = [film(problem.index, d, problem.wavelength_nm, problem.cos_theta) for d in variants]
        for name in got:
            expected = sum(weight * getattr(one, name) for weight, one in zip(weights, films, strict=True))
            np.testing.assert_allclose(got[name][row], expected, rtol=0, atol=TOLERANCE, err_msg=name)


def test_colours_are_sums_over_the_reference(device: Device) -> None:
    """The kernel of colours reads the same polynomials; weights are any."""
    problem = stack("absorbing")
    weights = np.random.default_rng(3).uniform(0, 1 / 45, (3, WAVELENGTH_NM.size))
    got = film_colours(device, problem, weights, (Side.REFLECTION, Side.TRANSMISSION), Precision.SINGLE)
    one = film(problem.index, problem.thickness_nm[0, 0], WAVELENGTH_NM, MU)
    for side, (s, p) in enumerate([(one.R_s, one.R_p), (one.T_s, one.T_p)]):
        np.testing.assert_allclose(got[side, 0], (s + p) / 2 @ weights.T, rtol=0, atol=TOLERANCE)


@pytest.mark.parametrize("name", ["metal", "into air"])
def test_psi_and_delta_are_those_of_the_reference(name: str, device: Device) -> None:
    """r_p / r_s comes of the same field, with its phase, which is all that total reflection has."""
    problem = replace(stack(name), cos_theta=MU[5:])
    got = film_ellipsometry(device, problem, Precision.SINGLE)
    at = film(problem.index, problem.thickness_nm[0, 0], WAVELENGTH_NM, MU[5:])
    np.testing.assert_allclose(got["psi"][0], at.psi, rtol=0, atol=1e-4)
    assert np.abs(np.exp(1j * got["Delta"][0]) - np.exp(1j * at.Delta)).max() <= 1e-4


@pytest.mark.parametrize(
    "change",
    [
        pytest.param({"thickness_nm": np.full((1, 1, 4), 900.0)}, id="too thick"),
        pytest.param({"thickness_nm": np.full((9_000, 1, 4), 90.0)}, id="too many numbers"),
    ],
)
def test_some_films_keep_their_layers(change: dict[str, np.ndarray]) -> None:
    """Where degree or memory speak against it."""
    assert stack_degree(replace(stack("clear"), **change), Precision.SINGLE) == 0


def test_double_precision_keeps_its_layers() -> None:
    """A degree for 53 bits would cost more than waves."""
    assert stack_degree(stack("clear"), Precision.DOUBLE) == 0


@pytest.mark.parametrize(("layers", "angles", "degree"), [(2, 4096, 0), (20, 4096, 12), (20, 64, 0)])
def test_a_stack_pays_with_many_layers_and_angles(
    layers: int, angles: int, degree: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Coefficients take time, and two layers are crossed faster than eight functions are summed."""
    monkeypatch.undo()
    monkeypatch.setattr(polynomials, "_FEWEST_EVALUATIONS", 0)
    n = [1.0, *[1.6, 1.4] * (layers // 2), 1.5]
    mu = np.linspace(0, 1, angles)
    problem = one_run(plain_problem(n, np.full(layers, 600.0 / layers), WAVELENGTH_NM, mu))
    assert stack_degree(problem, Precision.SINGLE) == degree
