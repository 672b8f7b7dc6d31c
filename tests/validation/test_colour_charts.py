"""The charts of docs/validation.md again, from the reference film and colour-science."""

from dataclasses import replace
from functools import cache
from itertools import permutations

import numpy as np
import pytest
from numpy.typing import NDArray

from nacreous.optics.material import Material
from nacreous.optics.refractive_index import refractive_index
from nacreous.tables.presets import preset
from reference import film
from reference_colour import WAVELENGTH_NM, linear_rgb
from validation import anodised_titanium, silica_on_silicon
from validation.baseline import shuffled, stretched
from validation.named_chart import TOLERANCE_NM, ChartColour, NamedChart

FloatArray = NDArray[np.float64]

CHARTS = [
    ("silica-on-silicon", silica_on_silicon, {600}),
    ("anodised-titanium", anodised_titanium, set()),
]
"""A preset, its comparison, and the thicknesses whose name does not hold."""
NAMES = [name for name, _, _ in CHARTS]


def look(preset_name: str, thickness_nm: FloatArray) -> FloatArray:
    """Lightness, chroma and hue of the preset's layer by the reference and colour-science, (N, 3)."""
    return lightness_chroma_hue(np.array([colour(preset_name, float(d)) for d in thickness_nm]))


@cache
def colour(preset_name: str, thickness_nm: float) -> FloatArray:
    """Linear Rec.709 of one thickness at normal incidence, (3,)."""
    stack = preset(preset_name).stack
    index = np.stack([held(m) for m in (stack.incident, stack.layers[0].material, stack.substrate)])
    at = film(index, np.array([thickness_nm]), WAVELENGTH_NM, 1.0)
    return linear_rgb(at.R_s[0])


def held(material: Material) -> NDArray[np.complex128]:
    """Return n + ik, its last value where the data end: the eye sees next to nothing there."""
    return refractive_index(material, np.clip(WAVELENGTH_NM, 360, 800))


def lightness_chroma_hue(rgb: FloatArray) -> FloatArray:
    """CIELAB of linear Rec.709 by colour-science."""
    import colour as colour_science

    white = colour_science.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]["D65"]
    space = colour_science.RGB_COLOURSPACES["ITU-R BT.709"]
    lab = colour_science.XYZ_to_Lab(rgb @ space.matrix_RGB_to_XYZ.T, white)
    L, a, b = np.moveaxis(lab, -1, 0)  # noqa: N806 - the symbol
    return np.stack([L, np.hypot(a, b), np.degrees(np.arctan2(b, a)) % 360], axis=-1)


@pytest.mark.parametrize(("name", "module", "missing"), CHARTS, ids=NAMES)
@pytest.mark.filterwarnings("ignore")  # colour-science's own
def test_the_literatures_names_hold_within_20_nm(name: str, module: object, missing: set[int]) -> None:
    """Pliskin & Conrad 1964, Diamanti et al. 2008: each name is near its thickness, but for those stated."""
    chart: tuple[ChartColour, ...] = module.CHART
    near = np.arange(-TOLERANCE_NM, TOLERANCE_NM + 1, 4.0)
    without = {
        each.thickness_nm for each in chart if not each.holds(look(name, each.thickness_nm + near)).any()
    }
    assert without == missing


@pytest.mark.parametrize(("name", "module", "missing"), CHARTS, ids=NAMES)
@pytest.mark.filterwarnings("ignore")  # colour-science's own
def test_the_hues_of_the_page_are_colour_sciences(name: str, module: object, missing: set[int]) -> None:
    """At the thicknesses of the chart: hue within 2 degrees, lightness and chroma within 1."""
    del missing
    chart: NamedChart = module.COMPARISON.measure()
    at_nm = np.array([each.thickness_nm for each in chart.colours])
    ours = chart.look[np.searchsorted(chart.thickness_nm, at_nm)]
    expected = look(name, at_nm)
    np.testing.assert_allclose(ours[:, :2], expected[:, :2], rtol=0, atol=1)
    turned = (ours[:, 2] - expected[:, 2] + 180) % 360 - 180
    assert np.abs(turned).max() <= 2


def test_an_offset_is_the_way_to_where_the_name_holds() -> None:
    """A film that is blue from 130 nm on is 30 nm off a chart that has blue at 100 nm."""
    thickness_nm = np.arange(50.0, 200.0)
    rgb = np.where((thickness_nm < 130)[:, None], [0.5, 0.2, 0.05], [0.1, 0.2, 0.6])
    chart = NamedChart("", (ChartColour(100, "blue"), ChartColour(150, "blue")), thickness_nm, rgb)
    np.testing.assert_array_equal(chart.offsets_nm, [30, 0])
    np.testing.assert_array_equal(chart.kept, [False, True])


def two_halves() -> NamedChart:
    """Return a film that is orange up to 150 nm and blue from there on, with two names of a chart."""
    thickness_nm = np.arange(50.0, 250.0)
    rgb = np.where((thickness_nm < 150)[:, None], [0.5, 0.2, 0.05], [0.1, 0.2, 0.6])
    return NamedChart("", (ChartColour(90, "gold"), ChartColour(170, "blue")), thickness_nm, rgb)


def test_the_baseline_of_shuffled_names_is_the_mean_over_every_order() -> None:
    """Counted order by order, with `itertools`; of two names that exclude each other one order holds."""
    chart = two_halves()
    assert shuffled(chart, 10.0) == 1.0  # 2 of 2, and 0 of 2
    places_nm = [90.0, 145.0, 170.0]
    names = ["gold", "blue", "blue"]
    counts = [
        replace(chart, colours=tuple(map(ChartColour, places_nm, order))).kept_within(10.0).sum()
        for order in permutations(names)
    ]
    three = replace(chart, colours=tuple(map(ChartColour, places_nm, names)))
    assert shuffled(three, 10.0) == pytest.approx(np.mean(counts))


def test_wrong_thicknesses_lose_names() -> None:
    """Of gold at 90 nm and blue from 150 nm on, read at 170 nm: seven tenths of 170 nm are 31 nm off."""
    assert [stretched(two_halves(), factor) for factor in (0.7, 0.9, 1.0, 1.1)] == [1, 2, 2, 2]
