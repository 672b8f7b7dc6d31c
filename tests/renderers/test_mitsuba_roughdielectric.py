"""Bare glass, rough: our f_r and f_t and the reference's against Mitsuba 3's own `roughdielectric`."""

from collections.abc import Callable

import numpy as np
import pytest

from mitsuba_surface import bsdf_values, dielectric
from nacreous.opencl.device import Device
from nacreous.tables.bsdf import bsdf_solver
from nacreous.tables.spec import Spec
from reference_facets import FloatArray, Surface
from reference_surface import Coating, cosine_direction, f_r, f_t, sample_refraction

N_GLASS = 1.5
ALPHAS = [0.05, 0.1, 0.4]
WAVELENGTH_NM = np.array([450.0, 620.0])
"""Glass of constant index looks the same at all of them."""
PAIRS = {"scalar_spectral": 1_000, "llvm_ad_spectral": 10_000}
"""Pairs of directions that are compared: as many as each variant does within a second."""

DirectionPairs = Callable[[int, float], tuple[FloatArray, FloatArray]]
Lobe = Callable[[Surface, Coating, FloatArray, FloatArray], FloatArray]

GLASS = Coating(np.array([[1.0], [N_GLASS]]) * np.ones(2, complex), np.zeros(0), WAVELENGTH_NM)


def reflected_pairs(count: int, _: float) -> tuple[FloatArray, FloatArray]:
    """Return independent directions (count, 3) above the surface."""
    u = np.random.default_rng(3).random((2, 2, count))
    return cosine_direction(u[0]), cosine_direction(u[1])


def transmitted_pairs(count: int, alpha: float) -> tuple[FloatArray, FloatArray]:
    """Return directions above the surface and, for each, one below that random facets bend it to."""
    u = np.random.default_rng(4).random((2, 2, count))
    i = cosine_direction(u[0])
    o = sample_refraction(Surface("ggx", alpha, alpha), i, u[1], 1.0, N_GLASS)
    passes = o[:, 2] < 0
    return i[passes], o[passes]


def reference_surface(alpha: float) -> Surface:
    """Return the one masking that Mitsuba has."""
    return Surface("ggx", alpha, alpha, "smith-separable")


def spec(alpha: float) -> Spec:
    """Return glass under a layer of no thickness, lit from vacuum."""
    return Spec.model_validate(
        {
            "stack": {
                "incident": "vacuum",
                "substrate": {"n": N_GLASS},
                "layers": [{"material": {"n": 2.0}, "thickness_nm": 0.0}],
            },
            "surface": {"distribution": "ggx", "masking": "smith-separable", "alpha_x": alpha},
            "table": {"quantity": "bsdf"},
        }
    )


@pytest.mark.parametrize("alpha", ALPHAS)
@pytest.mark.parametrize(("pairs", "f"), [(reflected_pairs, f_r), (transmitted_pairs, f_t)])
def test_the_reference_is_what_mitsuba_computes(
    pairs: DirectionPairs, f: Lobe, alpha: float, mitsuba_variant: str
) -> None:
    """GGX, separable Smith, Fresnel's dielectric: median within 1e-6, single precision's rounding beyond."""
    i, o = pairs(PAIRS[mitsuba_variant], alpha)
    expected = bsdf_values(dielectric(alpha, 1.0, N_GLASS), i, o, WAVELENGTH_NM)
    error = np.abs(f(reference_surface(alpha), GLASS, i, o) / expected - 1)
    assert np.median(error) <= 1e-6
    assert np.quantile(error, 0.99) <= 1e-5


@pytest.mark.parametrize("alpha", ALPHAS)
@pytest.mark.parametrize(
    ("pairs", "side"), [(reflected_pairs, "reflection"), (transmitted_pairs, "transmission")]
)
def test_our_lobes_are_what_mitsuba_computes(
    pairs: DirectionPairs, side: str, alpha: float, mitsuba_variant: str, device: Device
) -> None:
    """At 10,000 random directions: median within 1e-4, 99 of 100 within 1e-3."""
    i, o = pairs(PAIRS[mitsuba_variant], alpha)
    expected = bsdf_values(dielectric(alpha, 1.0, N_GLASS), i, o, WAVELENGTH_NM)
    got = getattr(bsdf_solver(device, spec(alpha)), side)(0, i, o, WAVELENGTH_NM)
    error = np.abs(got / expected - 1)
    assert np.median(error) <= 1e-4
    assert np.quantile(error, 0.99) <= 1e-3
