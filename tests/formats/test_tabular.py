"""The formats that hold arrays rather than pictures, each as the program it is for reads it."""

import json
from pathlib import Path

import netCDF4
import numpy as np
import pandas as pd
import pytest
import xarray

from analytic_tables import ALBEDO_AXES, BSDF_AXES, known
from nacreous.formats import csv, netcdf, npz
from nacreous.tables.table import Table

SPECTRA = ("R_s", "R_p", "T_s", "T_p", "psi", "Delta")
COLOURS = ("R_rgb", "T_rgb")
AXES = ("thickness_scale", "cos_theta", "wavelength_nm")


def test_npz_gives_numpy_every_array_exactly(table: Table, tmp_path: Path) -> None:
    """`numpy.load` as a user calls it, which refuses pickles."""
    npz.write(table, tmp_path / "film.npz")
    with np.load(tmp_path / "film.npz") as archive:
        for name in (*SPECTRA, *COLOURS, *AXES, "channel"):
            np.testing.assert_array_equal(archive[name], table.values(name), strict=True)
        assert str(archive["nacreous:id"]) == table.id
        assert json.loads(str(archive["nacreous:certificate"])) == table.certificate
        dims = json.loads(str(archive["nacreous:dims"]))
    assert dims["R_s"] == ["thickness_scale", "cos_theta", "wavelength_nm"]


def test_netcdf_gives_xarray_the_dataset(table: Table, tmp_path: Path) -> None:
    """What comes back is what `nacreous.tabulate` returns: values, axes, units, meanings and provenance."""
    netcdf.write(table, tmp_path / "film.nc")
    back = xarray.load_dataset(tmp_path / "film.nc", engine="h5netcdf")
    assert len(back.attrs.pop("nacreous:checksum")) == 64  # the file's own
    xarray.testing.assert_identical(back, table.to_xarray())


def test_netcdf_is_read_by_unidatas_library(table: Table, tmp_path: Path) -> None:
    """The reference implementation of the format, in C."""
    netcdf.write(table, tmp_path / "film.nc")
    with netCDF4.Dataset(str(tmp_path / "film.nc")) as dataset:
        for name in (*SPECTRA, *COLOURS, *AXES):
            np.testing.assert_array_equal(dataset[name][:].filled(), table.values(name))
        assert list(dataset["channel"][:]) == ["R", "G", "B"]
        assert dataset["wavelength_nm"].units == "nm"
        assert dataset["Delta"].units == "rad"
        assert dataset.getncattr("nacreous:id") == table.id


def test_csv_gives_pandas_a_tidy_table(table: Table, tmp_path: Path) -> None:
    """One row a sample, the wavelength fastest; nine digits bring float32 back exactly."""
    csv.write(table, tmp_path / "film.csv")
    frame = pd.read_csv(tmp_path / "film.csv", comment="#")
    assert list(frame.columns) == [*AXES, *SPECTRA]
    shape = table.values("R_s").shape
    for name in SPECTRA:
        column = frame[name].to_numpy().reshape(shape)
        np.testing.assert_array_equal(column.astype(np.float32), table.values(name))
    grid = np.meshgrid(*(table.values(axis) for axis in AXES), indexing="ij")
    for axis, values in zip(AXES, grid, strict=True):
        np.testing.assert_array_equal(frame[axis].to_numpy(), values.ravel())


def test_csv_says_where_it_comes_from(table: Table, tmp_path: Path) -> None:
    """The spec stays one line, whatever is in its name."""
    csv.write(table, tmp_path / "film.csv")
    comments = [line for line in (tmp_path / "film.csv").read_text("utf-8").splitlines() if line[0] == "#"]
    named = dict(line.removeprefix("# nacreous:").split(" = ", 1) for line in comments)
    assert named["id"] == table.id
    assert json.loads(named["spec"])["stack"] == table.spec.model_dump(mode="json")["stack"]


@pytest.mark.parametrize("suffix", [".npz", ".nc", ".csv"])
def test_a_table_beyond_the_visible_is_written_without_colours(
    infrared: Table, tmp_path: Path, suffix: str
) -> None:
    """Spectra need no colour."""
    path = tmp_path / f"film{suffix}"
    {".npz": npz.write, ".nc": netcdf.write, ".csv": csv.write}[suffix](infrared, path)
    read = {".npz": npz.read, ".nc": netcdf.read, ".csv": csv.read}[suffix](path)
    assert "R_s" in read.arrays
    assert "R_rgb" not in read.arrays


# ---- rough surfaces ----------------------------------------------------------------------------------------

ALBEDOS = ("E_r", "E_t", "E_r_mean", "E_t_mean", "E_r_rgb", "E_t_rgb")
BSDFS = ("f_r", "f_t", "f_r_rgb", "f_t_rgb")


def test_npz_holds_the_arrays_of_rough_surfaces(albedo: Table, bsdf: Table, tmp_path: Path) -> None:
    """The means of an albedo as well, and the axes of each array."""
    for table, names, axes in ((albedo, ALBEDOS, ALBEDO_AXES), (bsdf, BSDFS, BSDF_AXES)):
        npz.write(table, tmp_path / "film.npz")
        with np.load(tmp_path / "film.npz") as archive:
            dims = json.loads(str(archive["nacreous:dims"]))
            for name in names:
                np.testing.assert_array_equal(archive[name], table.values(name), strict=True)
            for axis, values in axes.items():
                np.testing.assert_array_equal(archive[axis], values)
            assert dims[names[0]] == [*axes, "wavelength_nm"]


def test_netcdf_selects_a_sample_by_its_place(albedo: Table, bsdf: Table, tmp_path: Path) -> None:
    """What xarray is for: a value by roughness, angles and wavelength, in radians and nm."""
    netcdf.write(albedo, tmp_path / "albedo.nc")
    netcdf.write(bsdf, tmp_path / "bsdf.nc")
    at = {"roughness": 0.4, "thickness_scale": 1.2, "cos_theta": 0.25, "wavelength_nm": 600.0}
    with xarray.open_dataset(tmp_path / "albedo.nc", engine="h5netcdf") as dataset:
        assert float(dataset.E_t.sel(at)) == pytest.approx(known("E_t", **at), rel=1e-6)
        assert dataset.E_r_mean.dims == ("roughness", "thickness_scale", "wavelength_nm")
    at = {"roughness": 0.3, "phi_i": 0.7, "theta_i": 1.0, "theta_o": 0.4, "phi": -1.5, "wavelength_nm": 710.0}
    with xarray.open_dataset(tmp_path / "bsdf.nc", engine="h5netcdf") as dataset:
        assert float(dataset.f_r.sel(at)) == pytest.approx(known("f_r", **at), rel=1e-6)
    with netCDF4.Dataset(str(tmp_path / "bsdf.nc")) as dataset:
        assert dataset["phi_i"].units == "rad"
        assert dataset["f_r"].dimensions == (*BSDF_AXES, "wavelength_nm")


def test_csv_gives_pandas_the_rows_of_rough_surfaces(albedo: Table, bsdf: Table, tmp_path: Path) -> None:
    """One row a sample: whatever the axes are, a row's value is that of its own samples."""
    for table, names, axes in ((albedo, ("E_r", "E_t"), ALBEDO_AXES), (bsdf, ("f_r", "f_t"), BSDF_AXES)):
        csv.write(table, tmp_path / "film.csv")
        frame = pd.read_csv(tmp_path / "film.csv", comment="#")
        columns = [*axes, "wavelength_nm"]
        assert list(frame.columns) == [*columns, *names]
        assert len(frame) == table.values(names[0]).size
        assert not frame.duplicated(subset=columns).any()
        for row in frame.sample(200, random_state=1, replace=True).to_dict("records"):
            at = {column: row[column] for column in columns}
            for name in names:
                assert row[name] == pytest.approx(known(name, **at), rel=1e-6)


def test_a_computed_bsdf_is_reciprocal_in_an_npz(computed_bsdf: Table, tmp_path: Path) -> None:
    """f_r(i, o) = f_r(o, i) (Helmholtz; Veach 1997, section 4.4): theta_i and theta_o change places."""
    npz.write(computed_bsdf, tmp_path / "film.npz")
    with np.load(tmp_path / "film.npz") as archive:
        f_r = archive["f_r"]  # (R, theta_i, theta_o, phi, L)
        assert list(archive["theta_i"]) == list(archive["theta_o"])
    np.testing.assert_allclose(f_r, f_r.swapaxes(1, 2), rtol=1e-5)


def test_a_computed_albedo_has_its_mean_in_a_netcdf(computed_albedo: Table, tmp_path: Path) -> None:
    """2 E cos_theta integrated over cos_theta, by Simpson's rule on the nine angles of the table."""
    netcdf.write(computed_albedo, tmp_path / "film.nc")
    with xarray.open_dataset(tmp_path / "film.nc", engine="h5netcdf") as dataset:
        weights = xarray.DataArray([1, 4, 2, 4, 2, 4, 2, 4, 1], dims="cos_theta") / 24
        mean = (2 * dataset.E_r * dataset.cos_theta * weights).sum("cos_theta")
        np.testing.assert_allclose(dataset.E_r_mean.transpose(*mean.dims), mean, atol=3e-3)


def test_a_computed_albedo_keeps_the_energy_in_a_csv(computed_albedo: Table, tmp_path: Path) -> None:
    """Nothing absorbs: the smooth surface loses next to nothing, the rough one what facets hide."""
    csv.write(computed_albedo, tmp_path / "film.csv")
    frame = pd.read_csv(tmp_path / "film.csv", comment="#")
    total = frame.E_r + frame.E_t
    assert total.max() <= 1 + 1e-3
    assert total[(frame.roughness == 0.02) & (frame.cos_theta > 0.3)].min() >= 0.99
    assert total[(frame.roughness == 0.4) & (frame.cos_theta > 0.3)].min() < 0.99
