"""Brushed surfaces of figures 6 and 7: their lobes, and a highlight on the teapot."""

import numpy as np
import pytest

from figures import studio
from figures.brushed import Brushed
from figures.figure_6 import TEAPOT
from figures.figure_7 import KANGAROO
from figures.lobe import lobe_of_file
from figures.studio import SoftBox
from figures.tables import Tables
from mitsuba_plugin import use_variant


@pytest.fixture(scope="module")
def tables(tmp_path_factory: pytest.TempPathFactory) -> Tables:
    """Files that several tests read."""
    return Tables(tmp_path_factory.mktemp("tables"))


@pytest.mark.parametrize("surface", [TEAPOT.rows[0][1], KANGAROO.rows[0][1]], ids=["teapot", "kangaroo"])
def test_a_file_has_the_lobe_of_equation_12(surface: Brushed, tables: Tables) -> None:
    """As Mitsuba reads it, a lobe is as wide along x and y as that of the slow reference, within 3 %."""
    use_variant(studio.VARIANT)
    file, exact = lobe_of_file(tables.written(surface.spec, ".bsdf")), surface.exact_lobe
    np.testing.assert_allclose([file.x_deg, file.y_deg], [exact.x_deg, exact.y_deg], rtol=0.03)


def test_lobes_spread_across_the_brush() -> None:
    """Widths go as 1 / sqrt(exponent): 1000 and 10 around the pot, 100 and 1000 up the animal."""
    around, upwards = TEAPOT.rows[0][1].exact_lobe, KANGAROO.rows[0][1].exact_lobe
    assert around.y_deg > 3 * around.x_deg
    assert upwards.x_deg > 2 * upwards.y_deg


def test_a_highlight_on_the_teapot_is_longer_across_the_brush_than_along_it(tables: Tables) -> None:
    """Brushed around, the belly of the pot spreads the light of a small lamp upwards and downwards."""
    use_variant(studio.VARIANT)
    lamp = studio.room(
        [SoftBox(190, 40, 6, 6, 100.0, edge_deg=1)], studio.Walls((0, 0, 0), (0, 0, 0), (0, 0, 0))
    )
    scene = TEAPOT.scene(tables, TEAPOT.rows[0][1], height=80) | {"light": lamp}
    picture = studio.rendered(scene, samples=64).mean(axis=-1)
    height, width = spread(picture[34:70, 35:75])
    assert height > 1.8 * width


def spread(light: np.ndarray) -> tuple[float, float]:
    """Return the standard deviations of light over rows and over columns, in pixels."""
    return tuple(_deviation(light.sum(axis=axis)) for axis in (1, 0))


def _deviation(share: np.ndarray) -> float:
    place = np.arange(len(share))
    mean = np.average(place, weights=share)
    return float(np.sqrt(np.average((place - mean) ** 2, weights=share)))
