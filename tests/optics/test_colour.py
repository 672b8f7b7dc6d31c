"""From spectrum to colour, against colour-science and the standards."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import reference_colour
from nacreous.optics.colour import colour_system, lab

OBSERVER = "CIE 1931 2 Degree Standard Observer"
SPACES = {"Rec.709": "ITU-R BT.709", "Rec.2020": "ITU-R BT.2020", "ACEScg": "ACEScg"}
SPECTRA: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "band": lambda nm: np.exp(-(((nm - 560) / 50) ** 2)),
    "fringes": lambda nm: 0.5 + 0.5 * np.cos(2 * np.pi * 3000 / nm),
    "edge": lambda nm: 1 / (1 + np.exp((nm - 590) / 8)),
}


@pytest.mark.parametrize("spectrum", SPECTRA)
@pytest.mark.parametrize("illuminant", ["D65", "A", "D50", "E"])
@pytest.mark.parametrize("space", SPACES)
def test_colours_agree_with_colour_science(space: str, illuminant: str, spectrum: str) -> None:
    """Its tristimulus integral at 1 nm, its Bradford matrix and its RGB matrix; 2e-4 is their rounding."""
    nm = reference_colour.WAVELENGTH_NM
    got = colour_system(illuminant, OBSERVER, space).weights(nm) @ SPECTRA[spectrum](nm)
    expected = reference_colour.linear_rgb(SPECTRA[spectrum](nm), illuminant=illuminant, space=SPACES[space])
    np.testing.assert_allclose(got, expected, rtol=0, atol=2e-4)


@pytest.mark.parametrize("observer", [OBSERVER, "CIE 1964 10 Degree Standard Observer"])
@pytest.mark.parametrize("illuminant", ["D65", "A", "C"])
def test_xyz_agrees_with_colour_science(illuminant: str, observer: str) -> None:
    """Y = 1 for a perfect reflector, X and Z as `colour.msds_to_XYZ` integrates them."""
    import colour

    nm = np.arange(380.0, 781.0)
    spectrum = SPECTRA["fringes"](nm)
    got = colour_system(illuminant, observer, "XYZ").weights(nm) @ spectrum
    shape = colour.SpectralShape(380, 780, 1)
    functions = colour.MSDS_CMFS[observer].copy().align(shape)
    source = colour.SDS_ILLUMINANTS[illuminant].copy().align(shape)
    expected = colour.msds_to_XYZ(spectrum, functions, source, method="Integration", shape=shape) / 100
    np.testing.assert_allclose(got, np.ravel(expected), rtol=0, atol=1e-3)


@pytest.mark.parametrize("space", SPACES)
def test_matrices_follow_from_the_primaries(space: str) -> None:
    """SMPTE RP 177: the columns are the primaries, scaled to sum to the white."""
    import colour

    standard = colour.RGB_COLOURSPACES[SPACES[space]]
    got = colour_system("D65", OBSERVER, space).xyz_from_space
    derived = colour.normalised_primary_matrix(standard.primaries, standard.whitepoint)
    np.testing.assert_allclose(got, derived, rtol=0, atol=1e-9)
    np.testing.assert_allclose(got, standard.matrix_RGB_to_XYZ, rtol=0, atol=1e-4)


GRIDS = st.lists(st.floats(380, 750), min_size=2, max_size=40, unique=True).map(
    lambda inner: np.array(sorted({400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0, *inner}))
)


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize("illuminant", ["D65", "A"])
@given(wavelength_nm=GRIDS)
def test_a_perfect_mirror_is_white_on_every_grid(
    illuminant: str, space: str, wavelength_nm: np.ndarray
) -> None:
    """The definition of white: R = 1 is (1, 1, 1) under every illuminant, however it is sampled."""
    weights = colour_system(illuminant, OBSERVER, space).weights(wavelength_nm)
    np.testing.assert_allclose(weights.sum(axis=1), 1, rtol=0, atol=1e-12)


@pytest.mark.parametrize(("illuminant", "xy"), [("D65", (0.31272, 0.32903)), ("A", (0.44758, 0.40745))])
def test_the_white_of_xyz_is_the_illuminants(illuminant: str, xy: tuple[float, float]) -> None:
    """CIE 15:2018, table of chromaticities: D65 (0.31272, 0.32903), A (0.44758, 0.40745)."""
    white = colour_system(illuminant, OBSERVER, "XYZ").white
    assert white[1] == pytest.approx(1, abs=1e-12)
    np.testing.assert_allclose(white[:2] / white.sum(), xy, rtol=0, atol=1e-4)


@pytest.mark.parametrize("space", [*SPACES, "XYZ"])
def test_white_is_lightness_100(space: str) -> None:
    """The space's (1, 1, 1), or XYZ's own white, is L* = 100, a* = b* = 0 (CIE 15:2018, 8.2.1)."""
    system = colour_system("D65", OBSERVER, space)
    white = system.white if space == "XYZ" else np.ones(3)
    np.testing.assert_allclose(lab(system.to_xyz(white), system.white), [100, 0, 0], rtol=0, atol=1e-9)


def test_lab_agrees_with_colour_science() -> None:
    """`colour.XYZ_to_Lab`, on both sides of the knee near black."""
    import colour

    xyz = np.random.default_rng(1).uniform(0, 1, (200, 3)) ** 4
    white = colour.xy_to_XYZ((0.3127, 0.3290))
    expected = colour.XYZ_to_Lab(xyz, (0.3127, 0.3290))
    np.testing.assert_allclose(lab(xyz, white), expected, rtol=0, atol=1e-9)


def test_a_colour_needs_what_the_observer_sees() -> None:
    """The range is where observer and illuminant overlap: 360 to 780 nm for D65 to 780."""
    first, last = colour_system("D65", OBSERVER, "Rec.709").range_nm
    assert (first, last) == (360, 780)
    assert (
        not colour_system("D65", OBSERVER, "Rec.709").weights(np.array([400.0, 550, 700, 900]))[:, -1].any()
    )
