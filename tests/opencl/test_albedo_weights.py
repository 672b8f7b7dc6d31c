"""Which angles to its facets a rough surface takes light at: energy, and an independent cubature."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from kernel_surface import (
    COMBINATIONS,
    FACETS,
    MASKINGS,
    alphas_of,
    directions_of,
    facets_of,
    mirrored_flux,
    stretched_hemisphere,
)
from lane_widths import lane_widths
from nacreous.errors import BudgetError
from nacreous.opencl import tiles
from nacreous.opencl.albedo_weights import AlbedoProblem, albedo_weights
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.microsurface import Microsurface, microsurface
from nacreous.opencl.precision import Precision
from nacreous.optics.facets import FacetRule
from reference_facets import FloatArray, Surface
from reference_surface import white_f_r

RULE = FacetRule(128, 32, 8)
NODES = 65
COSINES = np.array([0, 1e-3, 0.01, 0.03, 0.1, 0.12, 0.2, 0.35, 0.5, 0.75, 0.9, 1])


def reflected(surface: Microsurface, cos_theta: FloatArray = COSINES, nodes: int = NODES) -> AlbedoProblem:
    """Facets that reflect all light."""
    return AlbedoProblem(surface, Side.REFLECTION, cos_theta, nodes, RULE)


def refracted(surface: Microsurface, eta: float) -> AlbedoProblem:
    """Facets that transmit all light."""
    return AlbedoProblem(surface, Side.TRANSMISSION, COSINES, NODES, RULE, eta)


def furnace(device: Device, distribution: str, masking: str, *alphas: float) -> FloatArray:
    """Albedo of facets that reflect everything at `COSINES`, (A,), in single precision."""
    surface = facets_of(device, distribution, masking, *alphas)
    weights = albedo_weights(device, reflected(surface), Precision.SINGLE)
    return weights[0].sum(axis=-1, dtype=float)


@pytest.mark.parametrize(("distribution", "masking"), COMBINATIONS)
def test_a_white_furnace_gains_nothing(distribution: str, masking: str, device: Device) -> None:
    """R = 1: the albedo is at most 1 + 1e-4, alpha from 0.02 to 1, of any ratio, at any angle.

    Eq 13, Smith's G and the lobe of Sun 2006 lose only what a second bounce would bring.
    """
    surface = microsurface(device, distribution, masking, alphas_of(distribution))
    weights = albedo_weights(device, reflected(surface), Precision.SINGLE)
    E = weights.sum(axis=-1, dtype=float)
    assert np.isfinite(E).all()
    assert E.min() >= 0
    assert E.max() <= 1 + 1e-4


@pytest.mark.parametrize(("distribution", "masking"), [c for c in COMBINATIONS if c[0] != "ggx"])
def test_a_hardly_rough_surface_loses_nothing(distribution: str, masking: str, device: Device) -> None:
    """At alpha 0.02 and cosines from 0.12 a furnace keeps 0.999 of its light; at 0.1 the v-cavity 0.9987."""
    E = furnace(device, distribution, masking, 0.02)
    assert E[COSINES >= 0.12].min() >= 0.999
    assert E[COSINES >= 0.1].min() >= (0.9986 if masking == "v-cavity" else 0.999)


@pytest.mark.parametrize("masking", MASKINGS)
def test_tails_lose_light_at_any_roughness(masking: str, device: Device) -> None:
    """GGX at alpha 0.02: the facets steeper than 45 degrees, which send light from above down, lose it.

    Their share is 1 / (1 + 1 / alpha^2) of D cos, 4e-4 (Walter et al. 2007, eq 35); few of them, shadowed,
    cost more, and at cosine 0.1 two hundredths are lost.
    """
    E = furnace(device, "ggx", masking, 0.02)
    steep = 1 / (1 + 1 / 0.02**2)
    assert 1 - 2 * steep <= E[-1] <= 1 - 0.9 * steep
    assert 0.97 <= E[COSINES == 0.1].item() <= 0.985


@pytest.mark.parametrize("alpha", [0.02, 0.1, 0.4, 1.0])
@pytest.mark.parametrize(
    ("distribution", "masking"), [*product(FACETS[::2], MASKINGS), ("beckmann", "smith")]
)
def test_albedo_is_that_of_a_cubature(distribution: str, masking: str, alpha: float, device: Device) -> None:
    """Integral of f_r cos_o, NumPy's f_r over 32,768 facets: within 1.5e-4 at any angle; GGX's tails, too."""
    E = furnace(device, distribution, masking, alpha)
    for mu, got in zip(COSINES[4::3], E[4::3], strict=True):
        _, share = mirrored_flux(Surface(distribution, alpha, alpha, masking), float(mu))
        assert got == pytest.approx(share.sum(), abs=1.5e-4), mu


@pytest.mark.parametrize("masking", MASKINGS)
def test_an_anisotropic_albedo_is_the_mean_over_azimuths(masking: str, device: Device) -> None:
    """Light from 8 azimuths of a quarter, the same by the cubature."""
    surface = Surface("ggx", 0.2, 0.6, masking)
    E = furnace(device, "ggx", masking, 0.2, 0.6)
    azimuths = np.pi / 2 * (np.arange(8) + 0.5) / 8
    for mu in (0.1, 0.9):
        mean = np.mean([mirrored_flux(surface, mu, phi)[1].sum() for phi in azimuths])
        assert E[mu == COSINES].item() == pytest.approx(mean, abs=2e-4)


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_nodes_hold_cubics(degree: int, device: Device) -> None:
    """The light is placed so that a film of (i.h)^k, k <= 3, has the cubature's albedo: Lagrange is exact."""
    surface = facets_of(device, "beckmann", "smith", 0.4)
    weights = albedo_weights(device, reflected(surface, nodes=9), Precision.DOUBLE)[0]
    film = np.linspace(0, 1, 9) ** degree
    for mu in (0.2, 0.75):
        cosine, share = mirrored_flux(Surface("beckmann", 0.4, 0.4, "smith"), mu)
        assert weights[mu == COSINES] @ film == pytest.approx((cosine**degree @ share).item(), abs=1e-4)


def test_phong_is_its_lobe(device: Device) -> None:
    """After Sun 2006: the integral of L (i.h)(n.h) G / (cos_i cos_o) cos_o over the directions above."""
    surface = Surface("phong", 0.4, 0.4)
    E = furnace(device, "phong", "v-cavity", 0.4)
    o, solid_angle = stretched_hemisphere((1.0, 1.0), 384, 384)
    for mu in (0.1, 0.35, 0.9):
        i = directions_of(np.array(mu), np.array(0.0))
        expected = (white_f_r(surface, i, o) * o[:, 2]) @ solid_angle
        assert E[mu == COSINES].item() == pytest.approx(expected, abs=1e-4)


@pytest.mark.parametrize(("distribution", "masking"), list(product(FACETS, MASKINGS)))
def test_refraction_gains_nothing(distribution: str, masking: str, device: Device) -> None:
    """T = 1: the share that is refracted is at most 1 + 1e-4, into glass and out of it."""
    surface = microsurface(device, distribution, masking, alphas_of(distribution))
    for eta in (1 / 1.5, 1.5, 1.0):
        weights = albedo_weights(device, refracted(surface, eta), Precision.SINGLE)
        E = weights.sum(axis=-1, dtype=float)
        assert np.isfinite(E).all()
        assert E.max() <= 1 + 1e-4


def test_nothing_is_refracted_beyond_the_critical_angle(device: Device) -> None:
    """Snell: out of glass, facets at cosines below sqrt(1 - 1 / 1.5^2) = 0.745 pass nothing.

    A facet above it weighs on four nodes, the lowest of them up to two steps below.
    """
    surface = facets_of(device, "ggx", "smith", 0.3)
    weights = albedo_weights(device, refracted(surface, 1.5), Precision.DOUBLE)[0]
    critical = np.sqrt(1 - 1 / 1.5**2)
    below = np.linspace(0, 1, NODES) < critical - 2 / (NODES - 1)
    assert (weights[:, below] == 0).all()
    assert weights[:, ~below].sum(axis=-1).max() > 0.5


def test_equal_media_refract_nothing_aside(device: Device) -> None:
    """Eta = 1: light goes straight on through every facet that faces it, all of it but what is shadowed.

    With Smith's separable G, G1 of both directions: the integral is G1 cos / cos = G1 by Heitz 2014, eq 14.
    """
    alpha = 0.5
    surface = facets_of(device, "ggx", "smith-separable", alpha)
    weights = albedo_weights(device, refracted(surface, 1.0), Precision.DOUBLE)[0]
    mu = COSINES[3:]
    lit = 2 * mu / (mu + np.sqrt(mu**2 + alpha**2 * (1 - mu**2)))  # Walter et al. 2007, eq 34
    np.testing.assert_allclose(weights[3:].sum(axis=-1), lit, rtol=0, atol=1e-4)


def test_grazing_light_is_the_limit(device: Device) -> None:
    """Cosine 0 is as 1e-5, and finite."""
    surface = facets_of(device, "ashikhmin-shirley", "smith", 0.3)
    weights = albedo_weights(device, reflected(surface, np.array([0, 1e-5, 1e-4])), Precision.SINGLE)[0]
    np.testing.assert_array_equal(weights[0], weights[1])
    np.testing.assert_allclose(weights[1].sum(), weights[2].sum(), atol=1e-3)


@pytest.mark.parametrize("distribution", [*FACETS, "phong"])
def test_precisions_and_lanes_agree(distribution: str, device: Device) -> None:
    """1, 4, 8 or 16 facets at a time in either precision: the same weights."""
    surface = microsurface(device, distribution, "v-cavity", alphas_of(distribution)[[0, -1]])
    problem = replace(reflected(surface, COSINES[::3]), rule=FacetRule(33, 10, 3))
    exact = albedo_weights(device, problem, Precision.DOUBLE)
    for precision, tolerance in ((Precision.SINGLE, 2e-5), (Precision.DOUBLE, 1e-12)):
        for lanes in lane_widths(device, precision):
            got = albedo_weights(device, problem, precision, lanes=lanes)
            np.testing.assert_allclose(got, exact, rtol=0, atol=tolerance)


def test_tiles_do_not_matter(device: Device, monkeypatch: pytest.MonkeyPatch) -> None:
    """A row at a time or all at once: the same bytes, and the observer hears of each."""
    surface = microsurface(device, "ggx", "smith", alphas_of("ggx"))
    problem = replace(refracted(surface, 1 / 1.5), rule=FacetRule(16, 8, 2))
    whole = albedo_weights(device, problem, Precision.SINGLE)
    monkeypatch.setattr(tiles, "_FIRST_TILE_EVALUATIONS", 1)
    monkeypatch.setattr(tiles, "_MOST_GROWTH", 1)
    told: list[float] = []
    again = albedo_weights(device, problem, Precision.SINGLE, observer=told.append)
    assert again.tobytes() == whole.tobytes()
    assert len(told) == 2 * whole.shape[0] * whole.shape[1]  # from two azimuths
    assert told == sorted(told)
    assert told[-1] == 1


def test_too_many_weights_are_refused(device: Device, monkeypatch: pytest.MonkeyPatch) -> None:
    """The message has the size and the limit."""
    monkeypatch.setenv("NACREOUS_BYTE_BUDGET", "1k")
    with pytest.raises(BudgetError, match="weights of 1 x 12 x 65 nodes"):
        furnace(device, "ggx", "v-cavity", 0.3)
