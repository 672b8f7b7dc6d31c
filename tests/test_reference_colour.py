"""The reference colour against published figures and the definition of white."""

import numpy as np
import pytest

from reference_colour import WAVELENGTH_NM, film_colour, linear_rgb


@pytest.mark.parametrize(
    ("thickness_nm", "degrees", "expected"),
    [
        pytest.param(420, 0, (0.111, 0.085, 0.147), id="figure 3, normal"),
        pytest.param(420, 45, (0.246, 0.080, 0.194), id="figure 3, 45 degrees"),
        pytest.param(450, 0, (0.012, 0.160, 0.081), id="figure 4, normal"),
        pytest.param(450, 45, (0.118, 0.099, 0.155), id="figure 4, 45 degrees"),
    ],
)
def test_films_of_the_paper(thickness_nm: float, degrees: float, expected: tuple[float, ...]) -> None:
    """Figures 3 and 4 of Wu & Zheng 2015, n = 2.0 on 1.5 under D65: the design's linear Rec.709."""
    colour = film_colour(
        np.array([1, 2.0, 1.5], complex), np.array([thickness_nm]), np.cos(np.radians(degrees))
    )
    assert colour == pytest.approx(expected, abs=6e-4)


@pytest.mark.parametrize("illuminant", ["D65", "A", "E"])
def test_a_perfect_mirror_is_white(illuminant: str) -> None:
    """R = 1 is (1, 1, 1) under every illuminant: normalisation and adaptation."""
    assert linear_rgb(np.ones(WAVELENGTH_NM.shape), illuminant=illuminant) == pytest.approx(
        [1, 1, 1], abs=1e-12
    )


@pytest.mark.parametrize(("from_nm", "to_nm", "channel"), [(600, 700, 0), (510, 560, 1), (420, 480, 2)])
def test_bands_have_their_hue(from_nm: float, to_nm: float, channel: int) -> None:
    """Light of long, middle and short wavelengths is red, green and blue."""
    band = ((from_nm <= WAVELENGTH_NM) & (to_nm >= WAVELENGTH_NM)).astype(float)
    assert np.argmax(linear_rgb(band)) == channel


def test_colour_science_agrees_on_srgb() -> None:
    """colour.sd_to_XYZ (ASTM E308) and XYZ_to_sRGB, whose matrix is the standard's rounded one."""
    import colour

    reflectance = np.exp(-(((WAVELENGTH_NM - 600) / 60) ** 2))
    spectrum = colour.SpectralDistribution(reflectance, WAVELENGTH_NM)
    with pytest.warns(colour.utilities.ColourRuntimeWarning, match="Aligning"):
        xyz = colour.sd_to_XYZ(spectrum, illuminant=colour.SDS_ILLUMINANTS["D65"]) / 100
    expected = colour.XYZ_to_sRGB(xyz, apply_cctf_encoding=False)
    assert linear_rgb(reflectance) == pytest.approx(expected, abs=2e-4)


def test_adaptation_from_incandescent_light_is_bradfords() -> None:
    """Lindbloom, "Chromatic Adaptation", lists the Bradford matrix from illuminant A to D65."""
    import colour

    bradford = np.array(
        [
            [0.8446965, -0.1179225, 0.3948108],
            [-0.1366303, 1.1041226, 0.1291718],
            [0.0798489, -0.1348999, 3.1924009],
        ]
    )
    reflectance = np.exp(-(((WAVELENGTH_NM - 500) / 60) ** 2))
    spectrum = colour.SpectralDistribution(reflectance, WAVELENGTH_NM)
    with pytest.warns(colour.utilities.ColourRuntimeWarning, match="Aligning"):
        xyz = colour.sd_to_XYZ(spectrum, illuminant=colour.SDS_ILLUMINANTS["A"]) / 100
    expected = colour.RGB_COLOURSPACES["ITU-R BT.709"].matrix_XYZ_to_RGB @ bradford @ xyz
    assert linear_rgb(reflectance, illuminant="A") == pytest.approx(expected, abs=1e-3)
