"""A surface as the kernels take it: what they are built for, and the table of projected areas."""

import numpy as np
import pytest

from kernel_surface import STRETCHED, facets_of
from nacreous.opencl import microsurface as module
from nacreous.opencl.device import Device
from nacreous.opencl.microsurface import Microsurface, facet_rows, microsurface, surface_arguments
from nacreous.opencl.precision import Precision
from reference_facets import FloatArray, Surface, projected_area, unit


def directions_of_table(surface: Microsurface, roughness: int) -> FloatArray:
    """Return unit vectors (cosines, azimuths, 3) that have a table's mu / (mu + alpha s) and x share.

    S is the sine and alpha s = sqrt((alpha_x x)^2 + (alpha_y y)^2), as kernels/microfacet.clh says.
    """
    steepness, share = (np.linspace(0, 1, count) for count in surface.areas.shape[1:])
    alpha_x, alpha_y = surface.alphas[roughness]
    flat = 1 - steepness[:, None]
    x, y = flat * np.sqrt(share) / alpha_x, flat * np.sqrt(1 - share) / alpha_y
    return unit(np.stack(np.broadcast_arrays(x, y, steepness[:, None]), axis=-1))


def tabulated(surface: Microsurface, roughness: int) -> FloatArray:
    """Areas at `directions_of_table`, (cosines, azimuths): the table's, times mu + alpha s."""
    v = directions_of_table(surface, roughness)
    flat = np.linalg.norm(v[..., :2] * surface.alphas[roughness], axis=-1)
    return np.asarray(surface.areas[roughness] * (v[..., 2] + flat))


@pytest.mark.parametrize("alphas", [(0.02, 0.02), (0.25, 0.25), (1.0, 1.0), (0.02, 0.2), (0.3, 0.5)])
def test_areas_are_those_of_the_reference(alphas: tuple[float, float], device: Device) -> None:
    """Every entry, against an incomplete beta function over the tilt (`reference_facets`), to 1e-5."""
    surface = facets_of(device, "ashikhmin-shirley", "smith", *alphas)
    expected = projected_area(Surface("ashikhmin-shirley", *alphas), directions_of_table(surface, 0))
    np.testing.assert_allclose(tabulated(surface, 0), expected, rtol=1e-5)


@pytest.mark.parametrize("alphas", [(0.02, 0.02), (0.3, 0.3), (1.0, 1.0), *STRETCHED])
@pytest.mark.parametrize("distribution", ["ggx", "beckmann"])
def test_quadrature_finds_the_closed_forms(
    distribution: str, alphas: tuple[float, float], device: Device, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Heitz 2014, eq 66 and 72: what is integrated for others is what is known of these, to 1e-5."""
    monkeypatch.setattr(module, "_CLOSED_FORMS", ())
    surface = facets_of(device, distribution, "smith", *alphas)
    assert surface.areas.size > 1
    expected = projected_area(Surface(distribution, *alphas), directions_of_table(surface, 0))
    np.testing.assert_allclose(tabulated(surface, 0), expected, rtol=1e-5)


@pytest.mark.parametrize(
    ("distribution", "masking", "shape"),
    [
        ("ashikhmin-shirley", "v-cavity", (1, 1)),
        ("phong", "v-cavity", (1, 1)),
        ("ggx", "smith", (1, 1)),
        ("beckmann", "smith-separable", (1, 1)),
        ("blinn", "smith", (257, 2)),
        ("ashikhmin-shirley", "smith", (257, 2)),
    ],
)
def test_only_what_needs_a_table_has_one(
    distribution: str, masking: str, shape: tuple[int, int], device: Device
) -> None:
    """Eq 13 asks for no area, and two distributions have closed forms; an isotropic one has two azimuths."""
    surface = facets_of(device, distribution, masking, 0.3)
    assert surface.areas.shape == (1, *shape)
    numbers = dict(surface.build_numbers)
    assert (numbers["AREA_COSINES"], numbers["AREA_AZIMUTHS"]) == shape


def test_distributions_and_maskings_have_different_numbers(device: Device) -> None:
    """Five and three."""
    names = ("ashikhmin-shirley", "blinn", "phong", "ggx", "beckmann")
    numbers = [dict(facets_of(device, name, "v-cavity", 0.3).build_numbers)["DISTRIBUTION"] for name in names]
    assert sorted(numbers) == list(range(5))
    maskings = ("v-cavity", "smith", "smith-separable")
    numbers = [dict(facets_of(device, "ggx", name, 0.3).build_numbers)["MASKING"] for name in maskings]
    assert sorted(numbers) == list(range(3))


def test_each_roughness_has_its_own_table(device: Device) -> None:
    """What is integrated together is what is integrated alone."""
    alphas = np.array([[0.1, 0.2], [0.4, 0.8]])
    together = microsurface(device, "ashikhmin-shirley", "smith", alphas)
    for row, pair in zip(together.areas, alphas, strict=True):
        alone = microsurface(device, "ashikhmin-shirley", "smith", pair[None])
        np.testing.assert_allclose(row, alone.areas[0], rtol=1e-12)


def test_padding_weighs_nothing() -> None:
    """Sums over rows padded to whole lanes are the sums over the facets; the padding is a facet, too."""
    facets = np.arange(1.0, 1 + 2 * 4 * 13).reshape(2, 4, 13)
    rows = facet_rows(facets, 8)
    assert rows.shape == (2, 4, 16)
    np.testing.assert_array_equal(rows[:, 3].sum(axis=-1), facets[:, 3].sum(axis=-1))
    np.testing.assert_array_equal(rows[:, :3, 13:], np.repeat(facets[:, :3, 12:], 3, axis=-1))
    np.testing.assert_array_equal(facet_rows(facets, 1), facets)


def test_arguments_are_as_large_as_the_arrays(device: Device) -> None:
    """Two buffers, in the precision asked for."""
    surface = facets_of(device, "blinn", "smith", 0.3)
    for precision, size in ((Precision.SINGLE, 4), (Precision.DOUBLE, 8)):
        alphas, areas = surface_arguments(device, surface, precision)
        assert alphas.size == 2 * size
        assert areas.size == 257 * 2 * size
