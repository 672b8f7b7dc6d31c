"""A hundred million random samples in single precision: nothing overflows, nothing leaves [0, 1].

The law is conservation of energy. The bounds are those that tables/film.py refuses a table by, so that no
stack of these kinds is ever refused.
"""

from collections.abc import Callable

import numpy as np
import pytest

from nacreous.opencl import polynomials
from nacreous.opencl.device import Device
from nacreous.opencl.film import film_intensities
from nacreous.opencl.film_problem import FilmProblem, Segment
from nacreous.opencl.precision import Precision
from nacreous.tables.film import phase_precision

ANGLES, WAVELENGTHS, STACKS_A_KIND = 64, 512, 900
SAMPLES = 100_000_000
LEAST, MOST = -1e-6, 1 + 2e-5

Draw = Callable[[np.random.Generator, int], np.ndarray]
"""Random indices of some layers, (M,)."""


def dielectric(rng: np.random.Generator, layers: int) -> np.ndarray:
    """Clear layers, from water to rutile."""
    return rng.uniform(1.3, 2.7, layers) + 0j


def metallic(rng: np.random.Generator, layers: int) -> np.ndarray:
    """Metals between dielectrics."""
    metal = rng.uniform(0.05, 3.5, layers) + 1j * rng.uniform(0.5, 8, layers)
    return np.where(rng.random(layers) < 0.5, metal, dielectric(rng, layers))


def absorbing(rng: np.random.Generator, layers: int) -> np.ndarray:
    """Pigments and semiconductors, k over seven decades."""
    return rng.uniform(1, 5, layers) + 1j * 10 ** rng.uniform(-7, 0.5, layers)


def gaps(rng: np.random.Generator, layers: int) -> np.ndarray:
    """Gaps of low index, in which light from a dense medium is evanescent, between clear layers."""
    return np.where(rng.random(layers) < 0.5, rng.uniform(1, 1.4, layers), rng.uniform(1.4, 2.7, layers)) + 0j


def anything(rng: np.random.Generator, layers: int) -> np.ndarray:
    """Every kind of layer in one stack."""
    drawn = np.stack([draw(rng, layers) for draw in (dielectric, metallic, absorbing, gaps)])
    return drawn[rng.integers(0, 4, layers), np.arange(layers)]


KINDS = {
    "dielectric": (dielectric, 1.0),
    "metallic": (metallic, 1.0),
    "absorbing": (absorbing, 1.0),
    "total reflection": (gaps, 2.0),
    "anything": (anything, 1.0),
}


def cosines(rng: np.random.Generator) -> np.ndarray:
    """Both ends, and between them as many angles spread evenly as crowded towards grazing."""
    half = ANGLES // 2 - 1
    return np.sort(np.concatenate([[0.0, 1.0], rng.random(half), 10 ** rng.uniform(-6, 0, half)]))


def random_problem(rng: np.random.Generator, draw: Draw, most_incident: float) -> FilmProblem:
    """One to forty layers of 1 to 600 nm, each with a dispersion of its own, over the visible range."""
    layers = int(rng.integers(1, 41))
    n = draw(rng, layers + 1)
    n = n[:, None] * (1 + rng.uniform(-0.05, 0.05, layers + 1)[:, None] * np.linspace(-1, 1, WAVELENGTHS))
    incident = np.full((1, WAVELENGTHS), rng.uniform(1, most_incident), complex)
    return FilmProblem(
        wavelength_nm=np.linspace(350, 800, WAVELENGTHS),
        index=np.concatenate([incident, n]),
        segments=(Segment(0, layers, 1),),
        thickness_nm=10 ** rng.uniform(0, np.log10(600), (1, 1, layers)),
        weights=np.ones(1),
        cos_theta=cosines(rng),
    )


def test_a_hundred_million_samples(device: Device, monkeypatch: pytest.MonkeyPatch) -> None:
    """R and T are finite and within [-1e-6, 1 + 2e-5], R + T <= 1 + 2e-5, and = 1 where nothing absorbs."""
    monkeypatch.setattr(polynomials, "_FEWEST_EVALUATIONS", 0)  # thin ones and thin layers are polynomials
    single_samples = 0
    for kind, (draw, most_incident) in KINDS.items():
        rng = np.random.default_rng(sorted(KINDS).index(kind))
        for number in range(STACKS_A_KIND):
            problem = random_problem(rng, draw, most_incident)
            precision = phase_precision(problem, Precision.SINGLE)
            got = film_intensities(device, problem, precision)
            assert_lawful(got, f"{kind} {number}", lossless=not problem.index.imag.any())
            single_samples += got["R_s"].size if precision is Precision.SINGLE else 0
    assert single_samples >= SAMPLES


def assert_lawful(got: dict[str, np.ndarray], stack: str, *, lossless: bool) -> None:
    """Assert the bounds; a comparison with NaN is False, so that no value escapes them."""
    for name, values in got.items():
        assert values.min() >= LEAST, (stack, name)
        assert values.max() <= MOST, (stack, name)
    for R, T in (("R_s", "T_s"), ("R_p", "T_p")):
        total = got[R] + got[T]
        assert total.max() <= MOST, (stack, R, T)
        assert not lossless or total.min() >= 2 - MOST, (stack, R, T)
