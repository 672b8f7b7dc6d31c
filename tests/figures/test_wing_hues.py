"""The hues of figure 8's wings: exactly, over all angles, in our table and in a rendering."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from figures import studio
from figures.figure import Quality
from figures.figure_8 import BEST_DEG, VIEW, rendering
from figures.hue import lab, nearest_word
from figures.ridges import PAPER, THICKNESSES_NM, WORDS
from figures.tables import Tables
from mitsuba_plugin import use_variant
from reference import film
from reference_colour import WAVELENGTH_NM, linear_rgb

CUTICLE, PAIRS = 1.56 + 0.06j, 6
"""Vukusic et al. 1999; the number of pairs is the preset's assumption."""
THETA_DEG = np.arange(0.0, 86.0)
STATED = int(VIEW.facet_deg)


@cache
def exact_colours(thickness_nm: float) -> np.ndarray:
    """Return linear Rec.709 over THETA_DEG (A, 3): ridges and gaps as thick, by the slow reference."""
    ridges = film(
        np.array([1, CUTICLE, 1, 1]),
        [thickness_nm, thickness_nm],
        WAVELENGTH_NM,
        np.cos(np.radians(THETA_DEG)),
        groups=[(0, 2, PAIRS)],
    )
    return linear_rgb((ridges.R_s + ridges.R_p) / 2)


@cache
def exact_words(thickness_nm: float) -> tuple[str, ...]:
    """Return the word at each angle; its bounds are Munsell's hues, which test_hue.py checks."""
    return tuple(lab(colour).word for colour in exact_colours(thickness_nm))


def hue_deg(linear_rgb_: np.ndarray) -> np.ndarray:
    """Return h_ab of linear Rec.709 (..., 3) by way of colour-science."""
    import colour

    xyz = colour.RGB_to_XYZ(linear_rgb_, "ITU-R BT.709", apply_cctf_decoding=False)
    white = colour.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]["D65"]
    _, a, b = np.moveaxis(colour.XYZ_to_Lab(xyz, white), -1, 0)
    return np.degrees(np.arctan2(b, a)) % 360


def test_the_order_of_hues_is_the_papers() -> None:
    """Violet, blue and yellow hold in the stated geometry; where the paper has red there is orange."""
    words = [exact_words(thickness)[STATED] for thickness in THICKNESSES_NM]
    assert words == [*WORDS[:3], "orange"]
    hues = [hue_deg(exact_colours(thickness)[STATED]) for thickness in THICKNESSES_NM]
    assert (np.diff(hues) < 0).all()


def test_each_wing_has_its_word_in_a_direction_of_its_own() -> None:
    """Of the four words each is nearest to its own: along the normal, and 100 nm from 35 degrees."""
    hues = [hue_deg(exact_colours(d)[int(at)]) for d, at in zip(THICKNESSES_NM, BEST_DEG, strict=True)]
    assert tuple(nearest_word(hue, WORDS) for hue in hues) == WORDS
    assert (np.diff(hues) < 0).all()


def test_no_angle_gives_all_four_words() -> None:
    """Three of the paper's words hold from 25 to 26 degrees and nowhere else; the last wing is never red."""
    held = np.array([np.array(exact_words(d)) == w for d, w in zip(THICKNESSES_NM, WORDS, strict=True)])
    assert THETA_DEG[held.sum(axis=0) >= 3].tolist() == [25.0, 26.0]
    assert held.sum(axis=0).max() == 3
    assert not held[3].any()


@pytest.mark.parametrize("thickness_nm", THICKNESSES_NM)
def test_the_table_has_the_exact_hue(thickness_nm: float) -> None:
    """Our colour in the stated geometry is that of the reference, in steps of 5 nm instead of 1."""
    ours = PAPER.colours(thickness_nm, np.array([0.0, VIEW.facet_deg]))[1]
    np.testing.assert_allclose(ours, exact_colours(thickness_nm)[STATED], rtol=0, atol=2e-3)
    assert hue_deg(ours) == pytest.approx(hue_deg(exact_colours(thickness_nm)[STATED]), abs=0.5)


def test_the_rendered_wings_have_the_exact_hues(tmp_path: Path) -> None:
    """The median hue of a wing's pixels is that of its film: light and view meet its facets at one angle."""
    use_variant(studio.VARIANT)
    picture = rendering(Tables(tmp_path), VIEW, Quality(height=40, samples=256))
    hues = [wing_hue_deg(part) for part in np.array_split(picture, 4, axis=1)]
    exact = [hue_deg(exact_colours(thickness)[STATED]) for thickness in THICKNESSES_NM]
    np.testing.assert_allclose(hues, exact, rtol=0, atol=4)
    assert (np.diff(hues) < 0).all()


def wing_hue_deg(part: np.ndarray) -> float:
    """Return the median hue of the pixels that show film: ground, body and pigment are grey."""
    brightest, darkest = part.max(axis=-1), part.min(axis=-1)
    shows_film = brightest - darkest > 0.4 * brightest.max()
    assert shows_film.mean() > 0.1
    return float(np.median(hue_deg(part[shows_film] / brightest.max())))
