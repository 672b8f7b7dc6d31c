"""f_r and f_t of a rough surface with a film: against NumPy, and by their laws."""

from typing import Any

import numpy as np
import pytest

from kernel_surface import COMBINATIONS, ISOTROPIC, directions_of, random_directions, rough_spec, solvers_of
from nacreous.opencl.bsdf import Pairs
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.precision import Precision
from nacreous.optics.colour import colour_system
from nacreous.optics.stack import sample_stack
from nacreous.tables.bsdf.solver import BsdfSolver
from nacreous.tables.colour import Colouring
from reference_facets import Surface
from reference_surface import Coating, f_r, f_t

NM = np.array([400.0, 500.0, 600.0, 700.0])
DOWN = np.array([1.0, 1.0, -1.0])
COATING = Coating(np.array([1.0, 2.0, 1.5], complex)[:, None] * np.ones(4), np.array([300.0]), NM)


def solver_of(device: Device, surface: dict[str, Any], **spec: object) -> BsdfSolver:
    """Return the solver of 300 nm of n = 2.0 on glass, or of another substrate."""
    return solvers_of(device, rough_spec(surface, **spec))[1]


@pytest.mark.parametrize("alphas", [(0.1, 0.1), (0.2, 0.8)])
@pytest.mark.parametrize("distribution", ["ashikhmin-shirley", "ggx", "beckmann"])
def test_it_is_equation_12(distribution: str, alphas: tuple[float, float], device: Device) -> None:
    """All of it by NumPy, the film of tests/reference.py at each facet: 500 pairs to 2e-4 of the brightest.

    Both weights are there, and f_t of Walter et al. 2007, eq 21, below.
    """
    weights = {"specular_weight": 0.7, "diffuse_weight": 0.5, "diffuse_reflectance": 0.4}
    surface = {"distribution": distribution, "alpha_x": alphas[0], "alpha_y": alphas[1], **weights}
    solver, plain = solver_of(device, surface), Surface(distribution, *alphas, **weights)
    i, o = random_directions(500, 1), random_directions(500, 2)
    for got, expected in (
        (solver.reflection(0, i, o, NM), f_r(plain, COATING, i, o)),
        (solver.transmission(0, i, o * DOWN, NM), f_t(plain, COATING, i, o * DOWN)),
    ):
        np.testing.assert_allclose(got, expected, rtol=2e-4, atol=2e-4 * expected.max())


@pytest.mark.parametrize(
    ("distribution", "masking", "multiple_scattering"),
    [
        *((*combination, "none") for combination in COMBINATIONS),
        *((*combination, "kulla-conty") for combination in COMBINATIONS if combination[0] != "phong"),
    ],
)
def test_reflection_is_reciprocal(
    distribution: str, masking: str, multiple_scattering: str, device: Device
) -> None:
    """f_r(i, o) = f_r(o, i) to 1e-5 of itself, in single precision at 300 random pairs, with all terms."""
    alphas = {"alpha_x": 0.4} if distribution in ISOTROPIC else {"alpha_x": 0.2, "alpha_y": 0.8}
    surface = {"distribution": distribution, "masking": masking, "multiple_scattering": multiple_scattering}
    solver = solver_of(device, surface | alphas)
    assert solver.albedo.precision is Precision.SINGLE
    i, o = random_directions(300, 3), random_directions(300, 4)
    there, back = solver.reflection(0, i, o, NM), solver.reflection(0, o, i, NM)
    np.testing.assert_allclose(there, back, rtol=1e-5, atol=1e-30)


def test_kulla_conty_adds_what_the_albedo_lacks(device: Device) -> None:
    """It depends on both cosines alone, and is nowhere negative: the difference turned around is the same."""
    surface = {"distribution": "ggx", "masking": "smith", "alpha_x": 0.9}
    once, many = (solver_of(device, surface | {"multiple_scattering": m}) for m in ("none", "kulla-conty"))
    cosines = np.full(7, 0.4)
    i, o = directions_of(cosines, np.zeros(7)), directions_of(cosines + 0.3, np.linspace(0, 3, 7))
    added = many.reflection(0, i, o, NM).astype(float) - once.reflection(0, i, o, NM)
    assert added.min() > 0
    np.testing.assert_allclose(added, added[:1] * np.ones((7, 1)), rtol=1e-4)


@pytest.mark.parametrize("alpha", [0.1, 0.9])
def test_kulla_conty_between_many_cosines(alpha: float, device: Device) -> None:
    """A thousand directions share a table of lost light; ten at a time have their own: within 1e-4 of f_r."""
    surface = {
        "distribution": "ggx",
        "masking": "v-cavity",
        "alpha_x": alpha,
        "multiple_scattering": "kulla-conty",
    }
    solver = solver_of(device, surface)
    i, o = random_directions(1000, 11), random_directions(1000, 12)
    together = solver.reflection(0, i, o, NM)[:50]
    parts = [solver.reflection(0, i[at : at + 10], o[at : at + 10], NM) for at in range(0, 50, 10)]
    np.testing.assert_allclose(together, np.concatenate(parts), rtol=1e-4, atol=1e-6)


def test_each_wavelength_is_refracted_by_its_own_index(device: Device) -> None:
    """Snell at n, where alpha is 0.005: the lobe's brightest direction turns with the index of BK7.

    Between 400 and 700 nm it falls from 1.531 to 1.513, and the angle grows by 0.43 degrees.
    """
    spec = rough_spec({"distribution": "beckmann", "alpha_x": 0.005}, substrate="bk7")
    solver = solvers_of(device, spec)[1]
    index = sample_stack(spec.stack, NM).index[-1].real
    theta = np.linspace(0.5, 0.7, 2001)
    o = directions_of(np.cos(theta), np.full(2001, np.pi)) * DOWN
    i = directions_of(np.full(2001, 0.5), np.zeros(2001))
    flux = solver.transmission(0, i, o, NM) * np.cos(theta)[:, None]
    brightest = theta[flux.argmax(axis=0)]
    expected = np.arcsin(np.sqrt(0.75) / index)
    np.testing.assert_allclose(brightest, expected, rtol=0, atol=3e-4)
    assert expected[-1] - expected[0] > 0.007


@pytest.mark.parametrize("side", Side)
def test_a_colour_is_the_weighted_spectrum(side: Side, device: Device) -> None:
    """Linear, with all terms of the surface, and no spectrum stored."""
    surface = {"distribution": "ggx", "masking": "smith", "alpha_x": 0.6, "specular_weight": 0.7,
               "diffuse_weight": 0.5, "diffuse_reflectance": 0.3,
               "multiple_scattering": "kulla-conty"}  # fmt: skip
    nm = np.linspace(400, 700, 61)
    solver = solver_of(device, surface, substrate="bk7", wavelength_nm=list(nm))
    system = colour_system("D65", "CIE 1931 2 Degree Standard Observer", "Rec.709")
    colouring = Colouring(system, nm, system.weights(nm), 0.0)
    sign = 1 if side is Side.REFLECTION else -1
    o = random_directions(200, 6) * [1, 1, sign]
    pairs = Pairs(np.zeros(200, np.int32), random_directions(200, 5), o)
    spectra = solver.spectra(pairs, side, nm).astype(float)
    np.testing.assert_allclose(
        solver.colours(pairs, side, colouring), spectra @ colouring.weights.T, rtol=1e-4, atol=2e-5
    )


def test_a_white_diffuse_surface_is_1_over_pi(device: Device) -> None:
    """Lambert: f_r is the albedo over pi at any pair, and nothing else is there with specular_weight 0."""
    surface = {"alpha_x": 0.3, "specular_weight": 0.0, "diffuse_weight": 1.0, "diffuse_reflectance": 0.9}
    solver = solver_of(device, surface)
    f = solver.reflection(0, random_directions(50, 1), random_directions(50, 2), NM)
    np.testing.assert_allclose(f, 0.9 / np.pi, rtol=1e-6)
    f = solver.transmission(0, random_directions(50, 1), random_directions(50, 2) * DOWN, NM)
    assert (f == 0).all()


def test_sides_are_those_that_light_reaches(device: Device) -> None:
    """Glass has both, a metal and a lobe reflect, and equal media refract nothing aside."""
    both = (Side.REFLECTION, Side.TRANSMISSION)
    assert solver_of(device, {"alpha_x": 0.3}).sides(NM) == both
    assert solver_of(device, {"alpha_x": 0.3}, substrate={"n": 1.5, "k": 0.1}).sides(NM) == both[:1]
    assert solver_of(device, {"alpha_x": 0.3}, substrate="vacuum").sides(NM) == both[:1]
    assert solver_of(device, {"distribution": "phong", "alpha_x": 0.3}).sides(NM) == both[:1]


def test_roughness_is_a_place_on_the_axis(device: Device) -> None:
    """Each is the surface of that roughness alone."""
    axis = solver_of(device, {"distribution": "ggx"}, roughness=[0.1, 0.4])
    i, o = random_directions(50, 1), random_directions(50, 2)
    for place, alpha in enumerate((0.1, 0.4)):
        alone = solver_of(device, {"distribution": "ggx", "alpha_x": alpha})
        np.testing.assert_allclose(
            axis.reflection(place, i, o, NM), alone.reflection(0, i, o, NM), rtol=1e-4, atol=1e-6
        )


def test_an_exact_solver_is_in_double_precision(device: Device) -> None:
    """What errors are measured against."""
    exact = solver_of(device, {"alpha_x": 0.3}).exact()
    i, o = random_directions(20, 1), random_directions(20, 2)
    assert exact.reflection(0, i, o, NM).dtype == np.float64
    assert exact.albedo.film.solver.precision is Precision.DOUBLE


@pytest.mark.parametrize("distribution", ["phong", "ggx", "ashikhmin-shirley"])
def test_a_narrow_lobe_is_exact_in_single_precision(distribution: str, device: Device) -> None:
    """At alpha 0.003 a lobe is 0.2 degrees wide: single precision gives it within 1e-3 of double."""
    spec = rough_spec({"distribution": distribution, "alpha_x": 0.003}, quantity="bsdf")
    single = solvers_of(device, spec)[1]
    off = np.linspace(-0.01, 0.01, 41)
    theta = np.full(off.size, 0.7)
    i = directions_of(np.cos(theta), np.zeros(off.size))
    o = directions_of(np.cos(theta + off), np.full(off.size, np.pi))
    got, expected = (s.reflection(0, i, o, NM[:1])[:, 0] for s in (single, single.exact()))
    seen = expected > 1e-3 * expected.max()
    assert seen.sum() > 5
    np.testing.assert_allclose(got[seen], expected[seen], rtol=1e-3)
