"""Colour systems against the standards and against colour-science."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nacreous.optics.colour import colour_system, lab
from reference_colour import WAVELENGTH_NM, linear_rgb

OBSERVER = "CIE 1931 2 Degree Standard Observer"
SPACES = {"Rec.709": "ITU-R BT.709", "Rec.2020": "ITU-R BT.2020", "ACEScg": "ACEScg"}

pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize("illuminant", ["D65", "D50", "A", "E", "FL11"])
def test_colours_are_those_of_an_independent_integral(illuminant: str, space: str) -> None:
    """50 random spectra, by colour-science: 2e-5, the rounding of the standards' own matrices."""
    spectra = np.random.default_rng(3).uniform(0, 1, (50, WAVELENGTH_NM.size))
    ours = spectra @ colour_system(illuminant, OBSERVER, space).weights(WAVELENGTH_NM).T
    expected = linear_rgb(spectra, illuminant=illuminant, space=SPACES[space])
    np.testing.assert_allclose(ours, expected, rtol=0, atol=2e-5)


@given(
    step=st.floats(0.3, 20),
    first=st.floats(350, 400),
    space=st.sampled_from(["Rec.709", "Rec.2020", "ACEScg"]),
)
def test_a_perfect_reflector_is_white_on_any_grid(step: float, first: float, space: str) -> None:
    """R = 1 is (1, 1, 1), however coarse the wavelengths are."""
    wavelengths = np.arange(first, 780, step)
    weights = colour_system("D65", OBSERVER, space).weights(wavelengths)
    np.testing.assert_allclose(weights.sum(axis=1), 1, rtol=1e-12)


def test_xyz_of_a_perfect_reflector_is_the_illuminants_white() -> None:
    """Y = 1, and chromaticity (0.3127, 0.3290) for D65 (CIE 15:2018, table 11.1)."""
    white = colour_system("D65", OBSERVER, "XYZ").weights(np.arange(380.0, 781)).sum(axis=1)
    assert white[1] == pytest.approx(1)
    assert white[:2] / white.sum() == pytest.approx([0.3127, 0.3290], abs=5e-5)


@pytest.mark.parametrize("space", SPACES)
def test_matrices_are_the_standards(space: str) -> None:
    """Back from the space to XYZ by colour-science's matrix."""
    import colour

    system = colour_system("D65", OBSERVER, space)
    expected = colour.RGB_COLOURSPACES[SPACES[space]].matrix_RGB_to_XYZ
    np.testing.assert_allclose(system.to_xyz(np.eye(3)).T, expected, rtol=0, atol=1e-4)


def test_lab_is_colour_sciences() -> None:
    """L*a*b* of light and of very dark colours, on both sides of the knee."""
    import colour

    white = np.array([0.95047, 1.0, 1.08883])
    xyz = np.random.default_rng(1).uniform(0, 1, (1000, 3)) ** 4
    expected = colour.XYZ_to_Lab(xyz, colour.XYZ_to_xy(white))
    np.testing.assert_allclose(lab(xyz, white), expected, rtol=0, atol=1e-3)
