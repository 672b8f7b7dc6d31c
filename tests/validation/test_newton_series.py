"""Newton's colours again, from the law of a thin film without echoes and colour-science."""

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from reference_colour import WAVELENGTH_NM, linear_rgb
from validation.appearance import LUMINANCE, lightness_chroma_hue
from validation.named_chart import ChartColour
from validation.newton_series import NEWTON, TINTS_NM, measure

FloatArray = NDArray[np.float64]

PATH_NM = np.arange(20.0, 2200.0, 2.0)
TOLERANCE_NM = 2 * 1.334 * 20
"""Of a path; 20 nm of water."""


@cache
def ideal() -> FloatArray:
    """Linear Rec.709 of sin²(pi path / wavelength) over `PATH_NM`: a half wave lost, echoes left out."""
    return linear_rgb(np.sin(np.pi * PATH_NM[:, None] / WAVELENGTH_NM) ** 2)


def minima_nm(path_nm: FloatArray, luminance: FloatArray) -> FloatArray:
    """Return the paths that are darker than their neighbours."""
    inner = luminance[1:-1]
    return path_nm[1:-1][(inner < luminance[:-2]) & (inner <= luminance[2:])]


@pytest.mark.filterwarnings("ignore")  # colour-science's own
def test_the_law_has_michel_levys_tints() -> None:
    """Luminance is least at 551, 1101 and 1652 nm, within 1 %, and the colour there is purple."""
    darkest = minima_nm(PATH_NM, ideal() @ LUMINANCE)[: len(TINTS_NM)]
    np.testing.assert_allclose(darkest, TINTS_NM, rtol=0.01)
    hue = lightness_chroma_hue(ideal()[np.searchsorted(PATH_NM, darkest)])[:, 2]
    assert ((hue > 308) & (hue < 334)).all()


def test_the_film_has_them_at_its_own_thicknesses() -> None:
    """2 n d of the soap film's darkest thicknesses: the tints, within 1 %; n of water is 1.335 there."""
    series = measure()
    np.testing.assert_allclose(series.tint_paths_nm[: len(TINTS_NM)], TINTS_NM, rtol=0.01)
    assert series.n == pytest.approx(1.334, abs=0.002)
    assert series.luminance[0] < 1e-3  # the black film: a half wave is lost at one side alone


@pytest.mark.filterwarnings("ignore")  # colour-science's own
def test_newtons_names_hold() -> None:
    """Opticks, book II, part II: all colours of four orders but one orange are where he has them."""
    seen = lightness_chroma_hue(ideal())
    missed = []
    for line in NEWTON:
        near = np.abs(PATH_NM - line.path_nm) <= TOLERANCE_NM
        if not ChartColour(0.0, line.name).holds(seen[near]).any():
            missed.append((line.order, line.name))
    assert missed == [(2, "orange")]


def test_newtons_water_is_three_quarters_of_his_air() -> None:
    """He has 8 3/8 for water where he has 11 1/6 for air: violet of the second order, 213 nm."""
    violet = next(line for line in NEWTON if line.name == "violet")
    assert violet.air * 3 / 4 == pytest.approx(8 + 3 / 8, abs=0.01)
    assert violet.path_nm * 3 / 8 == pytest.approx((8 + 3 / 8) * 25.4, rel=1e-3)
