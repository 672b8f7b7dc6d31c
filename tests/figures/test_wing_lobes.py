"""The two lobes of figure 9, as Mitsuba reads their files."""

from pathlib import Path

import numpy as np
import pytest

from figures import studio
from figures.figure_9 import ISOTROPIC, SUN
from figures.lobe import lobe_of_file
from figures.tables import Tables
from mitsuba_plugin import use_variant

EXPONENT = 50
TURNS = {"phong": (SUN, 1), "facets": (ISOTROPIC, 2)}
"""By how many times the lean of a facet, or the angle in a Phong lobe, the light leaves its direction."""


@pytest.mark.parametrize("name", TURNS)
def test_facets_spread_light_twice_as_far_as_a_phong_lobe(name: str, tmp_path: Path) -> None:
    """cos^50 falls to a half at one angle: of the light in Phong's lobe, of the facets in the paper's."""
    use_variant(studio.VARIANT)
    model, turns = TURNS[name]
    half_deg = turns * np.degrees(np.arccos(0.5 ** (1 / EXPONENT)))
    lobe = lobe_of_file(Tables(tmp_path).written(model.spec, ".bsdf"))
    np.testing.assert_allclose([lobe.x_deg, lobe.y_deg], 2 * half_deg, rtol=0.03)
