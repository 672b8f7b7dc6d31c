"""Facets as a quadrature: sums over them are integrals over D cos, by a cubature of another kind."""

import numpy as np
import pytest

from kernel_surface import stretched_hemisphere
from nacreous.optics.facets import FacetRule, facet_quadrature, incident_azimuths
from reference_facets import FloatArray, Surface, density, phong_lobe

RULE = FacetRule(128, 32, 8)
UP = np.array([0.0, 0.0, 1.0])
ALPHAS = [(0.02, 0.02), (0.3, 0.3), (1.0, 1.0), (0.02, 0.2), (0.2, 0.02), (1.0, 0.1), (0.3, 0.5)]
FACETS = ("ashikhmin-shirley", "ggx", "beckmann")


def quadrature(distribution: str, alphas: tuple[float, float]) -> FloatArray:
    """Facets of one roughness, for light in the plane y = 0: (4, N)."""
    facets: FloatArray = facet_quadrature(distribution, np.array([alphas]), RULE)[0]
    return facets


def moments(h: FloatArray) -> FloatArray:
    """Smooth functions of a facet (..., 3) that are even in y, as half a circle needs: (5, ...)."""
    x, y, z = np.moveaxis(h, -1, 0)
    return np.stack([z, z**4, x**2, y**2, x**2 * z**2])


@pytest.mark.parametrize("alphas", ALPHAS)
@pytest.mark.parametrize("distribution", FACETS)
def test_sums_are_integrals_over_the_distribution(distribution: str, alphas: tuple[float, float]) -> None:
    """The sum of w g(h) is the integral of D cos g: Walter et al. 2007, eq 4, for g = 1 and five others."""
    x, y, z, weights = quadrature(distribution, alphas)
    h, solid_angle = stretched_hemisphere(alphas)
    flux = density(Surface(distribution, *alphas), UP, h) * h[:, 2] * solid_angle
    assert weights.sum() == pytest.approx(1, abs=1e-12)
    np.testing.assert_allclose(
        moments(np.stack([x, y, z], axis=-1)) @ weights, moments(h) @ flux, rtol=1e-5, atol=1e-6
    )


@pytest.mark.parametrize("alpha", [0.02, 0.3, 1.0])
def test_a_lobe_is_about_its_mirror_direction(alpha: float) -> None:
    """Sun 2006: the sum of w g is the integral of L g, L seen from above, where the mirror direction is n."""
    x, y, z, weights = quadrature("phong", (alpha, alpha))
    o, solid_angle = stretched_hemisphere((alpha, alpha))
    lobe = phong_lobe(Surface("phong", alpha, alpha), UP, o) * solid_angle
    assert weights.sum() == pytest.approx(1, abs=1e-12)
    np.testing.assert_allclose(
        moments(np.stack([x, y, z], axis=-1)) @ weights, moments(o) @ lobe, rtol=1e-5, atol=1e-9
    )


def test_gaussian_slopes_have_the_variance_of_their_roughness() -> None:
    """Beckmann 1963: the mean square of the slope along x is alpha_x^2 / 2, along y alpha_y^2 / 2."""
    x, y, z, weights = quadrature("beckmann", (0.1, 0.4))
    assert weights @ (x / z) ** 2 == pytest.approx(0.1**2 / 2, rel=1e-6)
    assert weights @ (y / z) ** 2 == pytest.approx(0.4**2 / 2, rel=1e-6)


@pytest.mark.parametrize("distribution", [*FACETS, "blinn", "phong"])
def test_facets_are_unit_vectors_above_the_surface(distribution: str) -> None:
    """Of length 1 and z > 0; an isotropic surface's lie on one side of the plane of incidence."""
    x, y, z, _ = quadrature(distribution, (0.5, 0.5))
    np.testing.assert_allclose(x**2 + y**2 + z**2, 1, rtol=1e-12)
    assert z.min() > 0
    assert y.min() > 0


def test_an_isotropic_surface_needs_one_azimuth() -> None:
    """It looks the same from all; one anisotropic roughness among many needs the quarter."""
    even, odd = np.array([[0.1, 0.1], [0.7, 0.7]]), np.array([[0.1, 0.2], [0.3, 0.6]])
    np.testing.assert_array_equal(incident_azimuths(even, RULE), [0.0])
    phi = incident_azimuths(odd, RULE)
    assert phi.size == RULE.incidence


@pytest.mark.parametrize("alphas", [(0.2, 0.2), (0.2, 0.3)])
def test_a_rule_tells_its_facets(alphas: tuple[float, float]) -> None:
    """As many as the quadrature has; an anisotropic surface takes both sides of the plane of incidence."""
    both = np.array([alphas, alphas])
    facets = facet_quadrature("ggx", both, RULE, 0.4)
    assert facets.shape == (2, 4, RULE.facets(both))


def test_azimuths_average_what_has_two_mirror_planes() -> None:
    """Over a quarter, the mean of cos^2 is 1/2 and that of cos 4 phi is 0."""
    phi = incident_azimuths(np.array([[0.1, 0.2]]), RULE)
    assert np.cos(phi) ** 2 @ np.full(phi.size, 1 / phi.size) == pytest.approx(0.5, abs=1e-12)
    assert np.cos(4 * phi).mean() == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("distribution", FACETS)
def test_every_azimuth_of_the_light_has_the_whole_surface(distribution: str) -> None:
    """The nodes turn with the light, and the integral stays."""
    alphas = np.array([[0.1, 0.6]])
    turned = [
        facet_quadrature(distribution, alphas, RULE, phi)[0] for phi in (0.0, 0.3, 1.0, np.pi / 2, -2.0)
    ]
    sums = [moments(facets[:3].T) @ facets[3] for facets in turned]
    np.testing.assert_allclose(sums, np.broadcast_to(sums[0], (5, 5)), rtol=0, atol=1e-5)
    assert not np.allclose(turned[0], turned[1])


def test_a_doubled_rule_has_twice_of_everything() -> None:
    """Four times the facets for each azimuth."""
    assert RULE.doubled() == FacetRule(256, 64, 16)
    alphas = np.array([[0.1, 0.2]])
    coarse, fine = (facet_quadrature("ggx", alphas, rule) for rule in (RULE, RULE.doubled()))
    assert fine.size == 4 * coarse.size
