"""f_r and f_t of the kernels at pairs of directions: against NumPy, and by their laws."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from kernel_surface import COMBINATIONS, FACETS, ISOTROPIC, facets_of, random_directions
from lane_widths import lane_widths
from nacreous.errors import BudgetError
from nacreous.opencl import tiles
from nacreous.opencl.bsdf import BsdfProblem, Pairs, bsdf_colours, bsdf_spectra
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.microsurface import microsurface
from nacreous.opencl.precision import Precision
from reference_facets import FloatArray, Surface
from reference_surface import Coating, f_t, white_f_r

NODES, PAIRS = 257, 10_000
DOWN = np.array([1.0, 1.0, -1.0])
ProblemOf = Callable[[Device, tuple[str, str, tuple[float, float]]], BsdfProblem]
"""`reflection` or `transmission`."""
SURFACES = [
    (name, masking, alphas)
    for name, masking in COMBINATIONS
    for alphas in ((0.3, 0.3), (0.3, 0.5))
    if alphas[0] == alphas[1] or name not in ISOTROPIC
]
ALBEDO = np.array([0.2, 0.9, 0.5])
SLOPE = np.array([0.7, -0.8, 0.0])


def reflection(device: Device, surface: tuple[str, str, tuple[float, float]], seed: int = 0) -> BsdfProblem:
    """Random pairs above a surface whose film is `ALBEDO` + `SLOPE` cos: three wavelengths."""
    distribution, masking, alphas = surface
    film = ALBEDO + SLOPE * np.linspace(0, 1, NODES)[:, None]
    eta = np.array([[1.0, 1.0, 1.0], [1.3, 1.5, 2.4]])
    i, o = random_directions(PAIRS, seed), random_directions(PAIRS, seed + 1)
    facets = facets_of(device, distribution, masking, *alphas)
    return BsdfProblem(facets, Side.REFLECTION, film, eta, Pairs(np.zeros(PAIRS, np.int32), i, o))


def transmission(device: Device, surface: tuple[str, str, tuple[float, float]], seed: int = 0) -> BsdfProblem:
    """Return the same with the outgoing directions below the surface."""
    problem = reflection(device, surface, seed)
    below = replace(problem.pairs, outgoing=problem.pairs.outgoing * DOWN)
    return replace(problem, side=Side.TRANSMISSION, pairs=below)


def swapped(problem: BsdfProblem) -> BsdfProblem:
    """Exchange incoming and outgoing light."""
    pairs = problem.pairs
    return replace(problem, pairs=replace(pairs, incoming=pairs.outgoing, outgoing=pairs.incoming))


def turned_over(problem: BsdfProblem) -> BsdfProblem:
    """Look at the same surface from below."""
    pairs = problem.pairs
    return replace(
        problem, pairs=replace(pairs, incoming=pairs.incoming * DOWN, outgoing=pairs.outgoing * DOWN)
    )


def expected_reflection(problem: BsdfProblem, surface: tuple[str, str, tuple[float, float]]) -> FloatArray:
    """D G / (4 cos_i cos_o) by NumPy, times the film at cos theta_d = sqrt((1 + i.o) / 2)."""
    distribution, masking, alphas = surface
    i, o = problem.pairs.incoming, problem.pairs.outgoing
    cos_d = np.sqrt((1 + (i * o).sum(axis=-1, keepdims=True)) / 2)
    return white_f_r(Surface(distribution, *alphas, masking), i, o)[:, None] * (ALBEDO + SLOPE * cos_d)


@pytest.mark.parametrize("surface", SURFACES)
def test_reflection_is_equation_12(surface: tuple[str, str, tuple[float, float]], device: Device) -> None:
    """Wu & Zheng 2015, eq 11 to 13, and their relatives, by NumPy at 10,000 random pairs."""
    problem = reflection(device, surface)
    expected = expected_reflection(problem, surface)
    exact = surface[1] == "v-cavity" or surface[0] in ("ggx", "beckmann")
    got = bsdf_spectra(device, problem, Precision.DOUBLE)
    np.testing.assert_allclose(got, expected, rtol=1e-9 if exact else 3e-5, atol=1e-12)
    got = bsdf_spectra(device, problem, Precision.SINGLE)
    np.testing.assert_allclose(got, expected, rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize("surface", SURFACES)
def test_reflection_is_reciprocal(surface: tuple[str, str, tuple[float, float]], device: Device) -> None:
    """Helmholtz: f_r(i, o) = f_r(o, i), to 1e-5 of itself in single precision at 10,000 random pairs."""
    problem = reflection(device, surface, 7)
    there, back = (bsdf_spectra(device, p, Precision.SINGLE) for p in (problem, swapped(problem)))
    assert there.min() >= 0
    np.testing.assert_allclose(there, back, rtol=1e-5, atol=1e-30)


@pytest.mark.parametrize("surface", [s for s in SURFACES if s[0] in FACETS])
def test_transmission_is_walters(surface: tuple[str, str, tuple[float, float]], device: Device) -> None:
    """Walter et al. 2007, eq 21, by NumPy, each wavelength refracted by its own index: 1.3, 1.5 and 2.4.

    The film is a bare boundary; its T is that of tests/reference.py, at the nodes and at each facet.
    """
    distribution, masking, alphas = surface
    problem = transmission(device, surface)
    coating = Coating(problem.eta.astype(complex), np.zeros(0), np.array([450.0, 550.0, 650.0]))
    _, T = coating.intensities(np.linspace(0, 1, NODES))
    problem = replace(problem, film=T)
    i, o = problem.pairs.incoming, problem.pairs.outgoing
    expected = f_t(Surface(distribution, *alphas, masking), coating, i, o)
    got = bsdf_spectra(device, problem, Precision.DOUBLE)
    assert (expected > 0).any()
    np.testing.assert_allclose(got, expected, rtol=5e-5, atol=1e-6)


def test_light_that_no_facet_refracts_is_0(device: Device) -> None:
    """From glass into air: no facet turns light by more than a right angle less the critical one.

    The half vector 1.5 i + o must face i and o from opposite sides: Walter et al. 2007, eq 16.
    """
    problem = transmission(device, ("ggx", "smith", (0.5, 0.5)))
    problem = replace(problem, eta=problem.eta[::-1])
    got = bsdf_spectra(device, problem, Precision.SINGLE)
    i, o = problem.pairs.incoming, problem.pairs.outgoing
    h = 1.5 * i + o
    h *= np.sign(h[:, 2:])
    passes = ((h * i).sum(-1) > 1e-4) & ((h * o).sum(-1) < -1e-4)
    refused = ((h * i).sum(-1) < -1e-4) | ((h * o).sum(-1) > 1e-4)
    assert refused.any()
    assert (got[refused, 1] == 0).all()
    assert (got[passes, 1] > 0).all()


@pytest.mark.parametrize("masking", ["v-cavity", "smith", "smith-separable"])
def test_transmission_is_reciprocal(masking: str, device: Device) -> None:
    """Walter et al. 2007, section 2: f_t(i, o) / n_o^2 = f_t(o, i) / n_i^2, turned over, one T for both."""
    forth = replace(transmission(device, ("beckmann", masking, (0.3, 0.5))), film=np.ones((NODES, 3)))
    back = turned_over(replace(swapped(forth), eta=forth.eta[::-1]))
    n_i, n_o = forth.eta
    there, here = (bsdf_spectra(device, p, Precision.DOUBLE) for p in (forth, back))
    np.testing.assert_allclose(there / n_o**2, here / n_i**2, rtol=1e-9, atol=1e-14)


@pytest.mark.parametrize("side", [reflection, transmission])
def test_a_colour_is_the_weighted_sum(side: ProblemOf, device: Device) -> None:
    """bsdf_colour.cl adds up what bsdf.cl gives."""
    problem = side(device, ("ggx", "smith", (0.3, 0.5)))
    weights = np.array([[0.1, 0.2, 0.3], [0.5, 0.0, -0.1], [0.0, 0.0, 2.0]])
    for precision, tolerance in ((Precision.SINGLE, 1e-5), (Precision.DOUBLE, 1e-13)):
        spectra = bsdf_spectra(device, problem, precision).astype(float)
        colours = bsdf_colours(device, problem, weights, precision)
        np.testing.assert_allclose(colours, spectra @ weights.T, rtol=tolerance, atol=tolerance)


@pytest.mark.parametrize("side", [reflection, transmission])
@pytest.mark.parametrize(
    "surface", [("ashikhmin-shirley", "smith", (0.3, 0.5)), ("ggx", "v-cavity", (0.1, 0.1))]
)
def test_precisions_and_lanes_agree(
    surface: tuple[str, str, tuple[float, float]], side: ProblemOf, device: Device
) -> None:
    """1, 4, 8 or 16 wavelengths at a time in either precision, and padding: the same numbers.

    Single precision to 1e-4 of the brightest pair: a refracting half vector is a difference of near equals.
    """
    problem = side(device, surface)
    exact = bsdf_spectra(device, problem, Precision.DOUBLE)
    brightest = exact.max()
    for precision, tolerance in ((Precision.SINGLE, 1e-4), (Precision.DOUBLE, 1e-12)):
        for lanes in lane_widths(device, precision):
            got = bsdf_spectra(device, problem, precision, lanes=lanes)
            np.testing.assert_allclose(got / brightest, exact / brightest, rtol=0, atol=tolerance)


def test_each_pair_has_its_own_roughness(device: Device) -> None:
    """Two roughnesses in one problem are what each of them is alone."""
    alphas = np.array([[0.1, 0.2], [0.5, 1.0]])
    one = reflection(device, ("ashikhmin-shirley", "smith", (0.1, 0.2)))
    facets = microsurface(device, "ashikhmin-shirley", "smith", alphas)
    two = replace(
        one, surface=facets, pairs=replace(one.pairs, roughness=np.arange(PAIRS, dtype=np.int32) % 2)
    )
    got = bsdf_spectra(device, two, Precision.DOUBLE)
    for place, (alpha_x, alpha_y) in enumerate(alphas):
        alone = replace(one, surface=facets_of(device, "ashikhmin-shirley", "smith", alpha_x, alpha_y))
        expected = bsdf_spectra(device, alone, Precision.DOUBLE)
        np.testing.assert_allclose(got[place::2], expected[place::2], rtol=1e-12)


@pytest.mark.parametrize("side", [reflection, transmission])
def test_tiles_do_not_matter(side: ProblemOf, device: Device, monkeypatch: pytest.MonkeyPatch) -> None:
    """A few pairs at a time or all at once: the same bytes; a tile uploads its own pairs."""
    problem = side(device, ("ggx", "smith", (0.3, 0.3)))
    pairs = problem.pairs
    few = replace(problem, pairs=Pairs(pairs.roughness[:301], pairs.incoming[:301], pairs.outgoing[:301]))
    whole = bsdf_spectra(device, few, Precision.SINGLE)
    monkeypatch.setattr(tiles, "_FIRST_TILE_EVALUATIONS", 500)
    monkeypatch.setattr(tiles, "_MOST_GROWTH", 1)
    told: list[float] = []
    assert bsdf_spectra(device, few, Precision.SINGLE, observer=told.append).tobytes() == whole.tobytes()
    assert len(told) > 10
    assert told[-1] == 1


def test_too_few_nodes_are_refused(device: Device) -> None:
    """A cubic goes through four."""
    problem = reflection(device, ("ggx", "smith", (0.3, 0.3)))
    with pytest.raises(ValueError, match="4 cosines or more, got 3"):
        replace(problem, film=problem.film[:3])


def test_too_many_pairs_are_refused(device: Device, monkeypatch: pytest.MonkeyPatch) -> None:
    """The messages have the size and the limit."""
    problem = reflection(device, ("ggx", "smith", (0.3, 0.3)))
    monkeypatch.setenv("NACREOUS_BYTE_BUDGET", "1k")
    with pytest.raises(BudgetError, match="a BSDF of 10,000 x 3 numbers"):
        bsdf_spectra(device, problem, Precision.SINGLE)
    with pytest.raises(BudgetError, match="colours of a BSDF of 10,000 pairs"):
        bsdf_colours(device, problem, np.ones((3, 3)), Precision.SINGLE)
