"""Facets: how many face one way, and how much of them a direction sees."""

import numpy as np
import pytest

from kernel_surface import FACETS, ISOTROPIC, ROUGH, STRETCHED, alphas_of, facets_of, stretched_hemisphere
from lane_widths import lane_widths
from nacreous.errors import BudgetError
from nacreous.opencl import tiles
from nacreous.opencl.device import Device
from nacreous.opencl.microfacets import microfacets
from nacreous.opencl.microsurface import microsurface
from nacreous.opencl.precision import Precision
from reference_facets import FloatArray, Surface, density, projected_area, unit

UP = np.array([0.0, 0.0, 1.0])
VIEWS = unit(
    np.array([[0.0, 0, 1], [0.6, 0.1, 0.8], [0.48, -0.36, 0.8], [-0.3, 0.95, 0.06], [1, 0.5, 0.004]])
)
"""From above to 0.2 degrees above the horizon."""
SURFACES = [
    (name, alphas)
    for name in FACETS
    for alphas in (*((alpha, alpha) for alpha in ROUGH), *(STRETCHED if name not in ISOTROPIC else ()))
]


@pytest.mark.parametrize("precision", Precision)
@pytest.mark.parametrize(("distribution", "alphas"), SURFACES)
def test_facets_cover_the_surface_once(
    distribution: str, alphas: tuple[float, float], precision: Precision, device: Device
) -> None:
    """The integral of D cos is 1 within 1e-4: Walter et al. 2007, eq 4, seen from above."""
    h, solid_angle = stretched_hemisphere(alphas)
    found, _ = microfacets(device, facets_of(device, distribution, "v-cavity", *alphas), h, precision)
    assert (found[0].astype(float) * h[:, 2]) @ solid_angle == pytest.approx(1, abs=1e-4)


@pytest.mark.parametrize(("distribution", "alphas"), SURFACES)
def test_density_is_the_references(distribution: str, alphas: tuple[float, float], device: Device) -> None:
    """Equation 11, Walter et al. 2007, eq 25 and 33, by NumPy: to 1e-9 down to 1e-8 of the peak.

    But for facets within 1e-5 rad of upright ones, which the kernels hold to be of one slope.
    """
    h, _ = stretched_hemisphere(alphas, 48, 24)
    h = h[h[:, 2] > 1e-5]
    found, _ = microfacets(device, facets_of(device, distribution, "v-cavity", *alphas), h, Precision.DOUBLE)
    expected = density(Surface(distribution, *alphas), UP, h)
    np.testing.assert_allclose(found[0], expected, rtol=1e-9, atol=1e-8 / (np.pi * alphas[0] * alphas[1]))


@pytest.mark.parametrize("precision", Precision)
@pytest.mark.parametrize(("distribution", "alphas"), SURFACES)
def test_there_is_no_hole_at_the_normal(
    distribution: str, alphas: tuple[float, float], precision: Precision, device: Device
) -> None:
    """D(n) is 1 / (pi alpha_x alpha_y), equation 11 at cos = 1 in terms of alpha, and D beside it as large.

    A few facets lean by 1e-8 to 1e-5 of the roughness, the first of them not at all in single precision.
    """
    lean = np.array([0, 0, 1e-8, 1e-7, 1e-6, 1e-5])[:, None] * unit(np.array([0.8, 0.6])) * min(alphas)
    h = np.concatenate([lean, np.sqrt(1 - (lean**2).sum(axis=-1, keepdims=True))], axis=-1)
    found, _ = microfacets(device, facets_of(device, distribution, "v-cavity", *alphas), h, precision)
    np.testing.assert_allclose(found[0], 1 / (np.pi * alphas[0] * alphas[1]), rtol=1e-6)


@pytest.mark.parametrize(("distribution", "alphas"), SURFACES)
def test_most_facets_face_up(distribution: str, alphas: tuple[float, float], device: Device) -> None:
    """D is largest at n: (1 + q)^-2 and cos^e fall by themselves, e^-q / cos^4 up to alpha 1 / sqrt 2.

    Beyond that the Gaussian distribution of slopes has its peak elsewhere: the derivative of (1 + t)^2
    e^(-t / alpha^2) is 2 - alpha^-2 at n.
    """
    h, _ = stretched_hemisphere(alphas, 48, 24)
    directions = np.concatenate([[UP], h])
    found, _ = microfacets(
        device, facets_of(device, distribution, "v-cavity", *alphas), directions, Precision.SINGLE
    )
    if distribution == "beckmann" and max(alphas) > np.sqrt(0.5):
        assert found[0].max() > found[0, 0]
    else:
        assert found[0].max() <= found[0, 0] * (1 + 1e-6)


@pytest.mark.parametrize("precision", Precision)
@pytest.mark.parametrize(("distribution", "alphas"), SURFACES)
def test_what_is_seen_of_the_facets_is_the_surface(
    distribution: str, alphas: tuple[float, float], precision: Precision, device: Device
) -> None:
    """Smith's G1 = cos / area obeys Heitz 2014, eq 14: the integral of G1 max(v.h, 0) D is cos, to 1e-4.

    Of Ashikhmin-Shirley and Blinn, whose areas are tabulated, as of GGX and Beckmann, whose are closed forms.
    """
    surface = facets_of(device, distribution, "smith", *alphas)
    h, solid_angle = stretched_hemisphere(alphas, 256, 256)
    found, _ = microfacets(device, surface, h, Precision.DOUBLE)
    _, area = microfacets(device, surface, VIEWS, precision)
    facing = np.maximum(VIEWS @ h.T, 0) @ (found[0] * solid_angle)
    cosine = VIEWS[:, 2]
    np.testing.assert_allclose(cosine / area[0] * facing, cosine, rtol=1e-4)


@pytest.mark.parametrize(
    ("distribution", "alphas"), [s for s in SURFACES if s[0] != FACETS[0] or s[1] not in STRETCHED[:-1]]
)
def test_area_is_the_references(distribution: str, alphas: tuple[float, float], device: Device) -> None:
    """Heitz 2014, eq 66 and 72, and an incomplete beta function: 2,000 directions between entries."""
    rng = np.random.default_rng(3)
    mu, phi = rng.uniform(0, 1, 2000) ** 3, rng.uniform(-np.pi, np.pi, 2000)
    v = np.stack([np.sqrt(1 - mu**2) * np.cos(phi), np.sqrt(1 - mu**2) * np.sin(phi), mu], axis=-1)
    for precision, tolerance in ((Precision.DOUBLE, 2e-5), (Precision.SINGLE, 3e-5)):
        _, area = microfacets(device, facets_of(device, distribution, "smith", *alphas), v, precision)
        np.testing.assert_allclose(area[0], projected_area(Surface(distribution, *alphas), v), rtol=tolerance)


@pytest.mark.parametrize("distribution", FACETS)
def test_precisions_and_lanes_agree(distribution: str, device: Device) -> None:
    """1, 4, 8 or 16 directions a work-item in either precision: the same facets, single to 1e-5."""
    surface = microsurface(device, distribution, "smith", alphas_of(distribution)[1:])
    h, _ = stretched_hemisphere((0.3, 0.3), 12, 11)
    exact = microfacets(device, surface, h, Precision.DOUBLE)
    for precision, tolerance in ((Precision.SINGLE, 1e-5), (Precision.DOUBLE, 1e-13)):
        for lanes in lane_widths(device, precision):
            got = microfacets(device, surface, h, precision, lanes=lanes)
            peak = exact[0].max(axis=1, keepdims=True)
            np.testing.assert_allclose(got[0] / peak, exact[0] / peak, rtol=0, atol=tolerance)
            np.testing.assert_allclose(got[1], exact[1], rtol=tolerance)


def test_tiles_do_not_matter(device: Device, monkeypatch: pytest.MonkeyPatch) -> None:
    """A row at a time or all at once: the same bytes."""
    surface = facets_of(device, "ashikhmin-shirley", "smith", 0.1, 0.4)
    h, _ = stretched_hemisphere((0.3, 0.3), 12, 11)

    def computed() -> tuple[FloatArray, ...]:
        return microfacets(device, surface, h, Precision.SINGLE)

    whole = computed()
    monkeypatch.setattr(tiles, "_FIRST_TILE_EVALUATIONS", 1)
    monkeypatch.setattr(tiles, "_MOST_GROWTH", 1)
    for got, expected in zip(computed(), whole, strict=True):
        assert got.tobytes() == expected.tobytes()


def test_too_many_directions_are_refused(device: Device, monkeypatch: pytest.MonkeyPatch) -> None:
    """The message has the size and the limit."""
    monkeypatch.setenv("NACREOUS_BYTE_BUDGET", "1k")
    with pytest.raises(BudgetError, match="1 x 1,000 microfacets"):
        microfacets(device, facets_of(device, "ggx", "smith", 0.1), np.tile(UP, (1000, 1)), Precision.SINGLE)
