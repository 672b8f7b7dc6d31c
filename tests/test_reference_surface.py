"""The reference surface against laws of energy and reciprocity, closed forms and finite differences."""

from functools import cache

import numpy as np
import pytest

from reference import film
from reference_facets import (
    FloatArray,
    Surface,
    density,
    dot,
    masking_shadowing,
    phong_lobe,
    projected_area,
    unit,
)
from reference_surface import (
    Coating,
    cosine_direction,
    f_r,
    f_t,
    kulla_conty,
    mirror,
    monte_carlo_albedo,
    refraction_half_vector,
    refraction_jacobian,
    sample_refraction,
    white_albedo,
)

FACETS = ("ashikhmin-shirley", "ggx", "beckmann")
"""The distributions of facets; Blinn's is Ashikhmin and Shirley's with equal exponents."""
ROUGHNESS = [(0.02, 0.02), (0.1, 0.1), (1.0, 1.0), (0.02, 0.2), (1.0, 0.1), (0.3, 0.5)]
UP = np.array([0.0, 0.0, 1.0])


@cache
def hemisphere(tilts: int = 300, azimuths: int = 240) -> tuple[FloatArray, FloatArray]:
    """Return directions (N, 3) and solid angles (N,): Gauss over the tilt's cube root, midpoints around."""
    x, gauss = np.polynomial.legendre.leggauss(tilts)
    root, around = (x + 1) / 2, 2 * np.pi * (np.arange(azimuths) + 0.5) / azimuths
    theta, phi = np.meshgrid(np.pi / 2 * root**3, around, indexing="ij")
    solid_angle = np.sin(theta) * (np.pi / 2 * 3 * root**2 * gauss / 2)[:, None] * (2 * np.pi / azimuths)
    directions = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1)
    return directions.reshape(-1, 3), solid_angle.ravel()


def random_directions(count: int, seed: int) -> FloatArray:
    """Return directions (count, 3) above the surface, as dense as the cosine."""
    return cosine_direction(np.random.default_rng(seed).random((2, count)))


def coating(*index: complex, thickness_nm: float = 120.0) -> Coating:
    """Return equal layers of thickness 120 nm at two wavelengths."""
    layers = np.full(len(index) - 2, thickness_nm)
    return Coating(np.array(index, complex)[:, None] * np.ones(2), layers, np.array([450.0, 620.0]))


GLASS = coating(1.0, 1.5)
FILM = coating(1.0, 2.0, 1.5)


@pytest.mark.parametrize("alphas", ROUGHNESS)
@pytest.mark.parametrize("distribution", FACETS)
def test_facets_cover_the_surface_once(distribution: str, alphas: tuple[float, float]) -> None:
    """The integral of D cos is 1: Walter et al. 2007, eq 4, seen from above."""
    h, solid_angle = hemisphere()
    density_of_h = density(Surface(distribution, *alphas), UP, h)
    assert (density_of_h * h[:, 2]) @ solid_angle == pytest.approx(1, abs=1e-10)


@pytest.mark.parametrize("alpha", [0.02, 0.3, 1.0])
def test_phongs_lobe_is_one_about_its_mirror_direction(alpha: float) -> None:
    """The integral of L over all directions is 1: seen from above, r = n."""
    o, solid_angle = hemisphere()
    lobe = phong_lobe(Surface("phong", alpha, alpha), UP, o)
    assert lobe @ solid_angle == pytest.approx(1, abs=1e-10)


def test_equation_11_by_hand() -> None:
    """e_x = 8, e_y = 3, cos_h = 0.8, phi = 30 degrees: sqrt(50)/(2 pi) 0.8^(6 + 0.75); at h = n no power."""
    surface = Surface("ashikhmin-shirley", np.sqrt(2 / 10), np.sqrt(2 / 5))
    h = np.array([0.6 * np.cos(np.pi / 6), 0.6 * np.sin(np.pi / 6), 0.8])
    peak = np.sqrt(50) / (2 * np.pi)
    assert density(surface, UP, h) == pytest.approx(peak * 0.8**6.75, rel=1e-12)
    assert density(surface, UP, UP) == pytest.approx(peak, rel=1e-12)


def test_small_roughness_means_the_same_to_all() -> None:
    """Walter et al. 2007, section 5.2: exponent 2 / alpha^2 - 2 makes Blinn's lobe Beckmann's."""
    h = unit(np.array([[0.004, 0.003, 1.0], [0.0, 0.009, 1.0]]))
    blinn, beckmann = (density(Surface(name, 0.005, 0.005), UP, h) for name in ("blinn", "beckmann"))
    np.testing.assert_allclose(blinn, beckmann, rtol=3e-4)


@pytest.mark.parametrize("alphas", ROUGHNESS)
@pytest.mark.parametrize("distribution", FACETS)
def test_projected_area_is_an_integral(distribution: str, alphas: tuple[float, float]) -> None:
    """Closed forms and incomplete beta functions against the integral of D max(v.h, 0): Heitz 2014, eq 25."""
    surface = Surface(distribution, *alphas, "smith")
    v = unit(
        np.array([[0.0, 0, 1], [0.6, 0.1, 0.8], [0.48, -0.36, 0.8], [-0.3, 0.95, 0.06], [1, 0.5, 0.004]])
    )
    h, solid_angle = hemisphere()
    integral = np.maximum(v @ h.T, 0) @ (density(surface, UP, h) * solid_angle)
    np.testing.assert_allclose(projected_area(surface, v), integral, rtol=2e-5)


@pytest.mark.parametrize("masking", ["v-cavity", "smith", "smith-separable"])
@pytest.mark.parametrize("distribution", FACETS)
def test_what_is_seen_of_the_facets_is_the_surface(distribution: str, masking: str) -> None:
    """The integral of G1 max(v.h, 0) D is cos: Heitz 2014, eq 14. From above nothing is masked: G is G1."""
    surface = Surface(distribution, 0.3, 0.5, masking)
    h, solid_angle = hemisphere()
    facets = density(surface, UP, h) * solid_angle
    for v in unit(np.array([[0.0, 0, 1], [0.6, 0.1, 0.8], [0.7, -0.7, 0.2]])):
        towards = dot(v, h) > 0
        visible = masking_shadowing(surface, v, UP, h[towards])
        seen = (visible * dot(v, h[towards])) @ facets[towards]
        assert seen == pytest.approx(v[2], rel=1e-5)


@pytest.mark.parametrize("alpha", [0.02, 0.1, 0.4, 1.0])
@pytest.mark.parametrize(
    ("distribution", "masking"),
    [(d, m) for d in FACETS for m in ("v-cavity", "smith", "smith-separable")] + [("phong", "v-cavity")],
)
def test_a_white_furnace_gains_nothing(distribution: str, masking: str, alpha: float) -> None:
    """R = 1 loses what a second bounce would bring: little at roughness 0.02, more in GGX's long tails."""
    surface = Surface(distribution, alpha, alpha, masking)
    for mu in (0.02, 0.12, 0.3, 0.7, 1.0):
        albedo = white_albedo(surface, mu, 256)
        assert albedo <= 1 + 1e-4, mu
        if alpha == 0.02 and mu > 0.1:
            least = 0.98 if distribution == "ggx" else 0.999
            assert albedo >= least, mu


@pytest.mark.parametrize("distribution", ["ashikhmin-shirley", "phong", "ggx", "beckmann"])
def test_reflection_is_reciprocal(distribution: str) -> None:
    """Helmholtz: f_r(i, o) = f_r(o, i)."""
    surface = Surface(distribution, 0.2, 0.2 if distribution == "phong" else 0.6)
    i, o = random_directions(500, 1), random_directions(500, 2)
    np.testing.assert_allclose(f_r(surface, FILM, i, o), f_r(surface, FILM, o, i), rtol=1e-11)


@pytest.mark.parametrize("masking", ["v-cavity", "smith", "smith-separable"])
def test_transmission_is_reciprocal(masking: str) -> None:
    """Walter et al. 2007, section 2: f_t(i, o) / n_o^2 = f_t(o, i) / n_i^2 through the film turned over."""
    surface, over = Surface("ggx", 0.2, 0.5, masking), np.array([1, 1, -1])
    i = random_directions(500, 3)
    o = sample_refraction(surface, i, np.random.default_rng(4).random((2, 500)), 1.0, 1.5)
    i, o = i[o[:, 2] < 0], o[o[:, 2] < 0]
    back = f_t(surface, coating(1.5, 2.0, 1.0), o * over, i * over)
    forth = f_t(surface, FILM, i, o)
    assert (forth > 0).all()
    np.testing.assert_allclose(forth / 1.5**2, back, rtol=1e-7)


@pytest.mark.parametrize(("n_i", "n_o"), [(1.0, 1.5), (1.5, 1.0), (1.2, 2.4)])
def test_refraction_obeys_snell_and_its_jacobian(n_i: float, n_o: float) -> None:
    """n_i sin_i = n_o sin_o at the facet; the solid angle of h for that of o by central differences."""
    i = np.broadcast_to(unit(np.array([0.3, 0.1, 0.9])), (200, 3))
    surface = Surface("ggx", 0.3, 0.3)
    o = sample_refraction(surface, i, np.random.default_rng(5).random((2, 200)), n_i, n_o)
    o = o[o[:, 2] < 0]
    i = i[: len(o)]
    h = refraction_half_vector(i, o, n_i, n_o)
    np.testing.assert_allclose(n_i * np.cross(i, h), -n_o * np.cross(o, h), atol=1e-12)
    a = unit(np.cross(o, UP))
    edges = [
        refraction_half_vector(i, unit(o + 1e-5 * across), n_i, n_o)
        - refraction_half_vector(i, unit(o - 1e-5 * across), n_i, n_o)
        for across in (a, np.cross(o, a))
    ]
    measured = np.linalg.norm(np.cross(*edges), axis=-1) / 4e-10
    np.testing.assert_allclose(refraction_jacobian(i, o, h, n_i, n_o), measured, rtol=1e-5)


@pytest.mark.parametrize("distribution", ["ashikhmin-shirley", "phong", "ggx", "beckmann"])
def test_without_roughness_it_is_the_film(distribution: str) -> None:
    """At roughness 0.001 the albedos are the film's R and T."""
    surface = Surface(distribution, 0.001, 0.001)
    got = monte_carlo_albedo(surface, FILM, 0.6, 4096, seed=6)
    smooth = film(*FILM, 0.6)
    np.testing.assert_allclose(got.E_r, (smooth.R_s + smooth.R_p)[0] / 2, rtol=0, atol=2e-4)
    if distribution != "phong":
        np.testing.assert_allclose(got.E_t, (smooth.T_s + smooth.T_p)[0] / 2, rtol=0, atol=1e-3)


@pytest.mark.parametrize("distribution", FACETS)
@pytest.mark.parametrize(("n_i", "n_o"), [(1.0, 1.5), (1.5, 1.0)])
def test_light_is_reflected_or_transmitted(distribution: str, n_i: float, n_o: float) -> None:
    """Without absorption E_r + E_t <= 1, and close to it where facets hardly hide each other."""
    got = monte_carlo_albedo(Surface(distribution, 0.1, 0.1), coating(n_i, 2.0, n_o), 0.8, 16384, seed=7)
    error = np.hypot(got.sigma_r, got.sigma_t)
    assert (error < 2e-3).all()
    assert (got.E_r + got.E_t <= 1 + 3 * error).all()
    assert (got.E_r + got.E_t >= 0.98 - 3 * error).all()


def test_nothing_comes_through_what_absorbs() -> None:
    """A substrate of k = 0.001 or more counts as opaque."""
    i, o = np.array([0.6, 0, 0.8]), np.array([-0.3, 0, -np.sqrt(0.91)])
    surface = Surface("ggx", 0.5, 0.5)
    assert (f_t(surface, coating(1, 1.5 + 0.9e-3j), i, o) > 0).all()
    assert (f_t(surface, coating(1, 1.5 + 1e-3j), i, o) == 0).all()


@pytest.mark.parametrize("surface", [Surface("ggx", 0.4, 0.4, "smith"), Surface("blinn", 0.6, 0.6, "smith"),
                                     Surface("ashikhmin-shirley", 0.2, 0.8)])  # fmt: skip
def test_brute_force_agrees_with_quadrature(surface: Surface) -> None:
    """The same integral at midpoints of the facets; Student's t of 31 exceeds 4.5 once in ten thousand."""
    for seed, mu in enumerate((0.15, 0.5, 0.9)):
        got = monte_carlo_albedo(surface, mirror(), mu, 8192, seed)
        assert abs(got.E_r[0] - white_albedo(surface, mu, 256)) <= 4.5 * got.sigma_r[0] + 1e-4


@pytest.mark.parametrize("F_mean", [1.0, 0.6])
def test_later_bounces_bring_back_what_the_first_loses(F_mean: float) -> None:
    """Kulla & Conty 2017: white facets lose nothing; Hill 2018: bounce k leaves F^(k+1) (1 - E)^k E."""
    mu, weight = np.polynomial.legendre.leggauss(24)
    mu, weight = (mu + 1) / 2, weight / 2
    E = np.array([white_albedo(Surface("ggx", 0.8, 0.8, "smith"), m, 128) for m in mu])
    E_mean = 2 * (E * mu) @ weight
    f_ms = kulla_conty(E[:, None], E, E_mean, F_mean)
    directional = 2 * np.pi * f_ms @ (mu * weight)
    series = sum(F_mean ** (k + 1) * (1 - E_mean) ** k * E_mean for k in range(1, 200))
    assert 2 * (directional * mu) @ weight == pytest.approx(series, rel=1e-9)
    if F_mean == 1:
        np.testing.assert_allclose(E + directional, 1, atol=1e-12)
