"""What certificates say of colours: the figures of given differences and texels."""

import numpy as np
import pytest

from nacreous.optics.colour import ColourSystem, colour_system
from nacreous.tables.colour import Colouring
from nacreous.tables.colour_figures import NO_COLOUR_FIGURES, colour_figures, colours_apart


@pytest.fixture(scope="module")
def system() -> ColourSystem:
    """Return linear sRGB under D65."""
    return colour_system("D65", "CIE 1931 2 Degree Standard Observer", "Rec.709")


def test_figures_are_those_of_the_differences(system: ColourSystem) -> None:
    """0 to 100 in equal steps: the 99th percentile is 99. A texel below 0 and one above 1, of four."""
    colouring = Colouring(system, np.zeros(0), np.zeros((3, 0)), 1e-4)
    texels = np.array([[0.5, 0.5, 0.5], [1.5, 0.5, 0.5], [0.5, -0.1, 0.5], [0.0, 1.0, 1.0 + 1e-6]])
    figures = colour_figures(np.linspace(0, 100, 101), texels, colouring)
    assert figures == {
        "delta_e_max": 100.0,
        "delta_e_p99": pytest.approx(99.0),
        "out_of_gamut": 0.5,
        "quadrature_error": 1e-4,
    }
    assert colour_figures(np.zeros(1), texels, colouring, brightest=np.inf)["out_of_gamut"] == 0.25
    assert NO_COLOUR_FIGURES.keys() == figures.keys()


@pytest.mark.filterwarnings("ignore")  # colour-science's own
def test_colours_are_as_far_apart_as_colour_science_says(system: ColourSystem) -> None:
    """Random linear colours: its XYZ_to_Lab and delta_E_CIE2000, to 0.01."""
    import colour

    rng = np.random.default_rng(4)
    pair = rng.uniform(0.02, 0.9, (2, 50, 3))
    matrix = colour.RGB_COLOURSPACES["ITU-R BT.709"].matrix_RGB_to_XYZ
    white = colour.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]["D65"]
    first, second = (colour.XYZ_to_Lab(rgb @ matrix.T, white) for rgb in pair)
    expected = colour.delta_E(first, second, method="CIE 2000")
    np.testing.assert_allclose(colours_apart(*pair, system), expected, rtol=0, atol=0.01)
