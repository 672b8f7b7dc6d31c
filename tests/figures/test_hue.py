"""Words for colours against the Munsell system and colour-science."""

import warnings

import numpy as np
import pytest

from figures.hue import lab
from reference_colour import WAVELENGTH_NM, linear_rgb

MUNSELL = {
    "5R": "red",
    "5YR": "orange",
    "5Y": "yellow",
    "5GY": "green",
    "5G": "green",
    "5BG": "cyan",
    "5B": "blue",
    "5PB": "blue",
    "10PB": "violet",
    "5P": "purple",
    "5RP": "magenta",
}
"""What a middle hue of the Munsell system is called in English."""


def munsell_rgb(hue: str) -> np.ndarray:
    """Return linear Rec.709 of a hue at value 5 and chroma 8, adapted from illuminant C."""
    import colour

    whites = colour.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # colour-science tells which optional packages it does without
        xyz = colour.xyY_to_XYZ(colour.munsell_colour_to_xyY(f"{hue} 5/8"))
    return np.asarray(
        colour.XYZ_to_RGB(xyz, "ITU-R BT.709", illuminant=whites["C"], apply_cctf_encoding=False)
    )


@pytest.mark.parametrize("hue", MUNSELL)
def test_middle_munsell_hues_have_their_names(hue: str) -> None:
    """The renotation of Newhall, Nickerson and Judd 1943."""
    assert lab(munsell_rgb(hue)).word == MUNSELL[hue]


def test_lab_is_that_of_colour_science() -> None:
    """CIE 15, 8.2.1, of colours in and out of the gamut, dark ones included."""
    import colour

    for rgb in np.random.default_rng(7).uniform(-0.002, 1.2, (50, 3)):
        expected = colour.XYZ_to_Lab(colour.RGB_to_XYZ(rgb, "ITU-R BT.709", apply_cctf_decoding=False))
        got = lab(rgb)
        np.testing.assert_allclose([got.lightness, got.a, got.b], expected, atol=0.02)


def test_a_flat_spectrum_is_grey() -> None:
    """R that is the same at all wavelengths has no hue."""
    assert lab(linear_rgb(np.full(WAVELENGTH_NM.shape, 0.2))).word == "grey"
