"""Bare silver, rough: our f_r and the reference's against Mitsuba 3's own `roughconductor`."""

import numpy as np
import pytest

from mitsuba_surface import bsdf_values, conductor
from nacreous.opencl.device import Device
from nacreous.optics.material import NamedMaterial
from nacreous.optics.refractive_index import refractive_index
from nacreous.tables.bsdf import bsdf_solver
from nacreous.tables.spec import Spec
from reference_facets import FloatArray, Surface
from reference_surface import Coating, cosine_direction, f_r

SILVER = "main/Ag/Johnson"
ALPHAS = [(0.05, 0.05), (0.1, 0.1), (0.4, 0.4), (0.6, 0.2), (0.05, 0.2)]
WAVELENGTHS = 16
PAIRS = {"scalar_spectral": 10_000 // WAVELENGTHS, "llvm_ad_spectral": 10_000}
"""Pairs of directions, each at all wavelengths: 10,000 samples one by one, 160,000 at once."""


def random_pairs(count: int, seed: int) -> tuple[FloatArray, FloatArray]:
    """Return incoming and outgoing directions (count, 3) above the surface, independent of each other."""
    u = np.random.default_rng(seed).random((2, 2, count))
    return cosine_direction(u[0]), cosine_direction(u[1])


def random_wavelengths_nm() -> FloatArray:
    """Return wavelengths of the visible range in ascending order."""
    return np.sort(np.random.default_rng(9).uniform(380, 780, WAVELENGTHS))


def silver(wavelength_nm: FloatArray) -> Coating:
    """Return silver in vacuum, without any layer."""
    index = refractive_index(NamedMaterial(name=SILVER), wavelength_nm)
    return Coating(np.stack([np.ones_like(index), index]), np.zeros(0), wavelength_nm)


def relative_error(got: FloatArray, expected: FloatArray) -> FloatArray:
    """Relative differences of two positive quantities."""
    assert (expected > 0).all()
    return np.abs(got / expected - 1)


@pytest.mark.parametrize("alphas", ALPHAS)
def test_the_reference_is_what_mitsuba_computes(alphas: tuple[float, float], mitsuba_variant: str) -> None:
    """GGX, separable Smith, Fresnel's conductor: median within 1e-6, single precision's rounding beyond."""
    wavelength_nm = random_wavelengths_nm()
    i, o = random_pairs(PAIRS[mitsuba_variant], seed=1)
    bare = silver(wavelength_nm)
    got = bsdf_values(conductor(*alphas, bare.index[-1], wavelength_nm), i, o, wavelength_nm)
    error = relative_error(got, f_r(Surface("ggx", *alphas, "smith-separable"), bare, i, o))
    assert np.median(error) <= 1e-6
    assert np.quantile(error, 0.99) <= 1e-5


@pytest.mark.parametrize("alphas", ALPHAS)
def test_our_reflection_is_what_mitsuba_computes(
    alphas: tuple[float, float], mitsuba_variant: str, device: Device
) -> None:
    """At 10,000 random directions and wavelengths: median within 1e-4, 99 of 100 within 1e-3."""
    wavelength_nm = random_wavelengths_nm()
    i, o = random_pairs(PAIRS[mitsuba_variant], seed=2)
    expected = bsdf_values(
        conductor(*alphas, silver(wavelength_nm).index[-1], wavelength_nm), i, o, wavelength_nm
    )
    solver = bsdf_solver(device, spec(alphas))
    error = relative_error(solver.reflection(0, i, o, wavelength_nm), expected)
    assert np.median(error) <= 1e-4
    assert np.quantile(error, 0.99) <= 1e-3


def spec(alphas: tuple[float, float]) -> Spec:
    """Return silver under a layer of no thickness, lit from vacuum."""
    nothing = {"material": {"n": 1.5}, "thickness_nm": 0.0}
    x, y = alphas
    return Spec.model_validate(
        {
            "stack": {"incident": "vacuum", "substrate": SILVER, "layers": [nothing]},
            "surface": {"distribution": "ggx", "masking": "smith-separable", "alpha_x": x, "alpha_y": y},
            "table": {"quantity": "bsdf"},
        }
    )
