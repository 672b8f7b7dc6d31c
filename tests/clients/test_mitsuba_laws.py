"""The BSDF plugin for Mitsuba: the laws of a BSDF, and Mitsuba's own surfaces as witnesses."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lut_contract import CONTRACT_SPEC
from mitsuba_plugin import (
    VARIANTS,
    WAVELENGTHS_NM,
    FloatArray,
    array,
    context,
    direction,
    film,
    interaction,
    random_directions,
    table_file,
    use_variant,
    vector,
)
from mitsuba_surface import conductor
from nacreous.optics.material import NamedMaterial
from nacreous.optics.refractive_index import refractive_index

VECTORISED = ("llvm_ad_rgb", "llvm_ad_spectral")
PAIRS = {"scalar_rgb": 1, "scalar_spectral": 1, "llvm_ad_rgb": 20_000, "llvm_ad_spectral": 20_000}
"""Pairs of directions at once; one at a time in the scalar variants, which are asked for `ROUNDS`."""
ROUNDS = {"scalar_rgb": 100, "scalar_spectral": 100, "llvm_ad_rgb": 1, "llvm_ad_spectral": 1}
ROUGHNESSES = [{"alpha": 0.3}, {"alpha_u": 0.15, "alpha_v": 0.5}]
N_GLASS = 1.5


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of the tables."""
    return tmp_path_factory.mktemp("laws")


def bare_spec(substrate: object) -> dict[str, Any]:
    """Return a substrate in vacuum under a layer of no thickness, sampled finely."""
    nothing = {"material": {"n": 2.0}, "thickness_nm": 0.0}
    return {
        "stack": {"incident": "vacuum", "substrate": substrate, "layers": [nothing]},
        "table": {"wavelength_nm": {"start": 380, "stop": 780, "step": 10}, "cos_theta": 257},
    }


def interpolation_error(file: Path) -> float:
    """Return the largest error between texels, which the file itself certifies."""
    import OpenImageIO

    certificate = OpenImageIO.ImageInput.open(str(file)).spec().getattribute("nacreous:certificate")
    return json.loads(certificate)["intensity_error_max"]


def pairs(variant: str, seed: int) -> list[tuple[FloatArray, FloatArray]]:
    """Return pairs of directions, (P, 3) each or (3,) in a scalar variant, as often as it is asked."""
    both = random_directions(2 * PAIRS[variant] * ROUNDS[variant], seed).reshape(ROUNDS[variant], 2, -1, 3)
    return [(i, o) if "llvm" in variant else (i[0], o[0]) for i, o in both]


def values(bsdf: object, wi: FloatArray, wo: FloatArray, mode: str) -> FloatArray:
    """Return f |cos θ_o| for pairs of directions."""
    return array(bsdf.eval(context(mode), interaction(wi), vector(wo)))


# ---- laws --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("roughness", ROUGHNESSES)
def test_light_and_radiance_are_adjoint(roughness: dict[str, float], variant: str, folder: Path) -> None:
    """For flux from i to o as for radiance from o to i (Veach 1997, section 5.2), on either side."""
    use_variant(variant)
    bsdf = film(table_file(folder, variant, CONTRACT_SPEC), thickness_scale=0.9, **roughness)
    for i, o in pairs(variant, seed=5):
        flux = values(bsdf, i, o, "Importance") / np.abs(o[..., 2:])
        radiance = values(bsdf, o, i, "Radiance") / np.abs(i[..., 2:])
        np.testing.assert_allclose(flux, radiance, rtol=2e-3, atol=1e-5)


@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("roughness", ROUGHNESSES)
@pytest.mark.parametrize("cos_theta", [0.9, 0.2, -0.9, -0.3])
def test_weight_times_density_is_the_value(
    cos_theta: float, roughness: dict[str, float], variant: str, folder: Path
) -> None:
    """`sample` returns f |cos θ_o| over the density that `pdf` has for its direction."""
    use_variant(variant)
    bsdf = film(table_file(folder, variant, CONTRACT_SPEC), thickness_scale=0.9, **roughness)
    for wi, u in sampling(variant, cos_theta):
        sample, weight = bsdf.sample(context(), interaction(wi), *u)
        f, density = bsdf.eval_pdf(context(), interaction(wi), sample.wo)
        alive = array(sample.pdf) > 1e-3
        assert alive.mean() > 0.5 or "scalar" in variant
        np.testing.assert_allclose(array(density)[alive], array(sample.pdf)[alive], rtol=1e-2)
        got = (array(weight) * array(sample.pdf)[..., None])[alive]
        np.testing.assert_allclose(got, array(f)[alive], rtol=1e-2, atol=1e-4)


def sampling(variant: str, cos_theta: float) -> list[tuple[FloatArray, tuple[Any, Any]]]:
    """Return directions and the numbers to sample from: one or many at once, as the variant is asked."""
    import mitsuba as mi

    u = np.random.default_rng(8).random((ROUNDS[variant], 3, PAIRS[variant])).astype(np.float32)
    wi = direction(cos_theta)
    if "scalar" in variant:
        return [(wi, (float(a[0]), [float(b[0]), float(c[0])])) for a, b, c in u]
    return [(np.tile(wi, (PAIRS[variant], 1)), (mi.Float(a), mi.Point2f(b, c))) for a, b, c in u]


@pytest.mark.parametrize("variant", VECTORISED)
@pytest.mark.parametrize("roughness", [{}, {"alpha": 0.05}, *ROUGHNESSES])
@pytest.mark.parametrize("cos_theta", [1.0, 0.5, 0.1, -1.0, -0.5, -0.1])
def test_no_energy_is_made(cos_theta: float, roughness: dict[str, float], variant: str, folder: Path) -> None:
    """R + T = 1 for a smooth film without absorption, from both sides; facets lose some to each other."""
    use_variant(variant)
    bsdf = film(table_file(folder, variant, CONTRACT_SPEC), thickness_scale=0.9, **roughness)
    ((wi, u),) = sampling(variant, cos_theta)
    albedo = array(bsdf.sample(context("Importance"), interaction(wi), *u)[1]).mean(axis=0)
    assert albedo.max() <= 1 + 2e-2  # the mean of 20,000 weights
    assert albedo.min() >= (0.7 if roughness else 0.98)


# ---- Mitsuba's own surfaces --------------------------------------------------------------------------------


@pytest.mark.parametrize("variant", ["scalar_spectral", "llvm_ad_spectral"])
@pytest.mark.parametrize("alphas", [(0.2, 0.2), (0.1, 0.4)])
def test_bare_silver_is_a_rough_conductor(alphas: tuple[float, float], variant: str, folder: Path) -> None:
    """`roughconductor` of the same index differs by no more than the table's interpolation."""
    use_variant(variant)
    file = table_file(folder, variant, bare_spec("main/Ag/Johnson"), "silver")
    ours = film(file, alpha_u=alphas[0], alpha_v=alphas[1])
    wavelength_nm = np.array([400.0, 450.0, 630.0, 640.0, 780.0])
    theirs = conductor(
        *alphas, refractive_index(NamedMaterial(name="main/Ag/Johnson"), wavelength_nm), wavelength_nm
    )
    tolerance = 2 * interpolation_error(file) + 1e-3  # of R: silver reflects more than half at all of them
    for i, o in pairs(variant, seed=6):
        expected, got = (values(bsdf, i, o, "Radiance") for bsdf in (theirs, ours))
        at = np.isin(WAVELENGTHS_NM, wavelength_nm)
        np.testing.assert_allclose(got[..., at], expected[..., at], rtol=tolerance, atol=1e-6)


@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("mode", ["Radiance", "Importance"])
@pytest.mark.parametrize("alpha", [0.1, 0.4])
def test_bare_glass_is_a_rough_dielectric(alpha: float, mode: str, variant: str, folder: Path) -> None:
    """`roughdielectric` differs by no more than the table's interpolation: R and T, from both sides."""
    use_variant(variant)
    import mitsuba as mi

    file = table_file(folder, variant, bare_spec({"n": N_GLASS}), "glass")
    glass = {
        "type": "roughdielectric",
        "distribution": "ggx",
        "alpha": alpha,
        "ext_ior": 1.0,
        "int_ior": N_GLASS,
    }
    ours, theirs = film(file, alpha=alpha), mi.load_dict(glass)
    for i, o in pairs(variant, seed=7):
        expected, got = (values(bsdf, i, o, mode) for bsdf in (theirs, ours))
        lit = expected > 1e-4
        share = np.broadcast_to(glass_share(i, o)[..., None], lit.shape)[lit]
        error = np.abs(got[lit] / expected[lit] - 1) * share
        assert error.max(initial=0) <= interpolation_error(file) + 1e-3  # single precision's, of small angles


def glass_share(i: FloatArray, o: FloatArray) -> FloatArray:
    """Return Fresnel's R or T = 1 - R, unpolarised, of the facet between two directions (P, 3) or (3,)."""
    reflects = i[..., 2] * o[..., 2] > 0
    eta = np.where(i[..., 2] > 0, N_GLASS, 1 / N_GLASS)
    half = i + o * np.where(reflects, 1, eta)[..., None]
    cos_i = np.abs((i * half).sum(-1)) / np.linalg.norm(half, axis=-1)
    cos_o = np.sqrt(np.maximum(1 - (1 - cos_i**2) / eta**2, 0))
    r_s, r_p = (cos_i - eta * cos_o) / (cos_i + eta * cos_o), (eta * cos_i - cos_o) / (eta * cos_i + cos_o)
    reflected = (r_s**2 + r_p**2) / 2
    return np.where(reflects, reflected, 1 - reflected)


@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("cos_theta", [1.0, 0.7, 0.2, -0.2, -0.8, -1.0])
@pytest.mark.parametrize("mode", ["Radiance", "Importance"])
def test_bare_glass_is_a_smooth_dielectric(mode: str, cos_theta: float, variant: str, folder: Path) -> None:
    """`dielectric` reflects and refracts to the same directions, as much, beyond the critical angle too."""
    use_variant(variant)
    import mitsuba as mi

    file = table_file(folder, variant, bare_spec({"n": N_GLASS}), "glass")
    glass = mi.load_dict({"type": "dielectric", "ext_ior": 1.0, "int_ior": N_GLASS})
    for component in (0, 1):
        arguments = context(mode, component), interaction(direction(cos_theta)), 0.5, [0.5, 0.5]
        (got, weight), (expected, their_weight) = film(file).sample(*arguments), glass.sample(*arguments)
        np.testing.assert_allclose(array(weight), array(their_weight), rtol=0, atol=1e-3)
        if array(their_weight).any():
            np.testing.assert_allclose(array(got.wo), array(expected.wo), atol=1e-5)
            np.testing.assert_allclose(array(got.eta), array(expected.eta), rtol=1e-5)
            assert array(got.sampled_type) == array(expected.sampled_type)
