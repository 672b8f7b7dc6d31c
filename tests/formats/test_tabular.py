"""The formats that hold arrays rather than pictures, each as the program it is for reads it."""

import json
from pathlib import Path

import netCDF4
import numpy as np
import pandas as pd
import pytest
import xarray

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
    assert json.loads(named["spec"])["name"] == table.spec.name


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
