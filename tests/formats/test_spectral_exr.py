"""The spectral EXR as colour-science reads it, after Fichet, Pacanowski and Wilkie, JCGT 10(3), 2021."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import OpenEXR
import pytest

from analytic_tables import known
from nacreous.errors import FileFormatError
from nacreous.formats import spectral_exr
from nacreous.tables.table import Table
from reference import film


def spectra(path: Path) -> tuple[np.ndarray, np.ndarray, Any]:
    """Return wavelengths in nm, the spectra (H, W, L) and colour-science's view of the file."""
    from colour.io import read_spectral_image_Fichet2021

    components, specification = read_spectral_image_Fichet2021(str(path), additional_data=True)
    assert set(components) == {"T"}  # reflective or transmissive layers alone
    wavelength_nm, values = components["T"]
    return wavelength_nm, values, specification


@pytest.mark.parametrize(
    ("suffix", "quantity"), [(".spectral.exr", "R"), (".transmission.spectral.exr", "T")]
)
def test_holds_the_unpolarised_spectra(table: Table, tmp_path: Path, suffix: str, quantity: str) -> None:
    """Unpolarised light is the mean of s and p (Born & Wolf, section 1.5.3)."""
    spectral_exr.write(table, tmp_path / "film.spectral.exr")
    wavelength_nm, values, _ = spectra(tmp_path / f"film{suffix}")
    np.testing.assert_array_equal(wavelength_nm, table.values("wavelength_nm"))
    mean = (table.values(f"{quantity}_s") + table.values(f"{quantity}_p")) / 2
    np.testing.assert_array_equal(values, mean)


def test_the_film_of_figure_3_has_the_reflectance_of_equation_1(table: Table, tmp_path: Path) -> None:
    """Third row: scale 1; against the sum of beams of Wu & Zheng 2015, equation 1."""
    spectral_exr.write(table, tmp_path / "film.spectral.exr")
    wavelength_nm, values, _ = spectra(tmp_path / "film.spectral.exr")
    air = 1.000277  # within 5e-5 over the visible (Ciddor 1996)
    at = film([air, 2.0, 1.5], [420.0], wavelength_nm, table.values("cos_theta"))
    np.testing.assert_allclose(values[2], (at.R_s + at.R_p) / 2, atol=2e-4)


def test_is_a_reflective_layout_with_a_preview(table: Table, tmp_path: Path) -> None:
    """Section 3 of the layout: its version, an exposure, and R, G, B for programs without spectra."""
    spectral_exr.write(table, tmp_path / "film.spectral.exr")
    _, _, specification = spectra(tmp_path / "film.spectral.exr")
    assert not specification.is_emissive
    attributes = {attribute.name: attribute.value for attribute in specification.attributes}
    assert attributes["spectralLayoutVersion"] == "1.0"
    assert attributes["EV"] == 0
    assert attributes["nacreous:id"] == table.id
    with OpenEXR.File(str(tmp_path / "film.spectral.exr")) as file:
        np.testing.assert_array_equal(file.channels()["RGB"].pixels, table.values("R_rgb"))


def test_writes_wavelengths_with_a_decimal_comma(tabulated: Callable[..., Table], tmp_path: Path) -> None:
    """Section 3.2 of the layout; a dot would separate another part of the channel's name."""
    spectral_exr.write(tabulated(wavelength_nm=[390, 550.5, 700.25]), tmp_path / "film.spectral.exr")
    with OpenEXR.File(str(tmp_path / "film.spectral.exr"), separate_channels=True) as file:
        layers = {name for name in file.channels() if name.startswith("T")}
    assert layers == {"T.390,000000nm", "T.550,500000nm", "T.700,250000nm"}


def test_a_table_beyond_the_visible_has_no_preview(infrared: Table, tmp_path: Path) -> None:
    """Spectra need no colour; names, not the order in the file, say which wavelength a channel is."""
    files = spectral_exr.write(infrared, tmp_path / "film.spectral.exr")
    assert len(files) == 2
    wavelength_nm, values, _ = spectra(tmp_path / "film.spectral.exr")
    order = np.argsort(wavelength_nm)
    np.testing.assert_array_equal(wavelength_nm[order], infrared.values("wavelength_nm"))
    mean = (infrared.values("R_s") + infrared.values("R_p")) / 2
    np.testing.assert_array_equal(values[:1, :, order], mean)
    np.testing.assert_array_equal(
        spectral_exr.read(files[0]).arrays["R"][:1], mean
    )  # our own reader sorts them


@pytest.mark.parametrize(
    ("suffix", "name"), [(".spectral.exr", "E_r"), (".transmission.spectral.exr", "E_t")]
)
def test_holds_the_spectra_of_an_albedo(albedo: Table, tmp_path: Path, suffix: str, name: str) -> None:
    """A share of the light is what a reflective layer holds; tiles of thickness lie one below the other."""
    spectral_exr.write(albedo, tmp_path / "film.spectral.exr")
    wavelength_nm, values, specification = spectra(tmp_path / f"film{suffix}")
    assert not specification.is_emissive
    assert values.shape == (3 * 4, 5, 4)
    at = {"roughness": 0.4, "thickness_scale": 1.2, "cos_theta": 0.25}
    expected = [known(name, **at, wavelength_nm=nm) for nm in wavelength_nm]
    np.testing.assert_allclose(values[2 * 4 + 2, 1], expected, rtol=1e-6)


def test_an_all_but_smooth_albedo_has_the_reflectance_of_equation_1(
    computed_albedo: Table, tmp_path: Path
) -> None:
    """Roughness 0.02 at scale 1, the third row, head on; against the sum of beams of Wu & Zheng 2015."""
    spectral_exr.write(computed_albedo, tmp_path / "film.spectral.exr")
    wavelength_nm, values, _ = spectra(tmp_path / "film.spectral.exr")
    at = film([1.000277, 2.0, 1.5], [420.0], wavelength_nm, np.ones(1))
    np.testing.assert_allclose(values[2, -1], (at.R_s[0] + at.R_p[0]) / 2, atol=2e-3)


def test_has_no_layer_for_a_bsdf(bsdf: Table, tmp_path: Path) -> None:
    """The layout's layers are shares or radiances; the message names the formats that hold it."""
    with pytest.raises(FileFormatError, match="got bsdf; npz, netcdf and exr hold it"):
        spectral_exr.write(bsdf, tmp_path / "film.spectral.exr")
    assert list(tmp_path.iterdir()) == []
