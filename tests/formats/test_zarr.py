"""Zarr archives, opened as anyone opens them: by Zarr's own store, by xarray, and by unzip."""

import hashlib
import json
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
import xarray
import zarr
from zarr.storage import ZipStore

from nacreous.errors import FileFormatError
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS, write
from nacreous.formats.verify import verify
from nacreous.tables.table import Table

ZARR = FORMATS[FormatName.ZARR]


def opened(path: Path) -> xarray.Dataset:
    """Return the dataset as the manual says it is opened."""
    with ZipStore(path, mode="r") as store:
        return xarray.open_zarr(store, chunks=None, consolidated=False).load()


@pytest.mark.parametrize("name", ["table", "albedo", "bsdf"])
def test_xarray_reads_every_array_with_its_unit(
    request: pytest.FixtureRequest, tmp_path: Path, name: str
) -> None:
    """Values, axes, units, meanings and provenance are those of the dataset that a user computes."""
    table: Table = request.getfixturevalue(name)
    (path,) = write(table, tmp_path / "film.zarr")
    expected = table.to_xarray()
    got = opened(path)
    xarray.testing.assert_equal(got.drop_vars("channel"), expected.drop_vars("channel"))
    assert got["channel"].values.tolist() == expected["channel"].values.tolist()
    assert {key: array.attrs for key, array in got.variables.items()} == {
        key: array.attrs for key, array in expected.variables.items()
    }
    assert got.attrs.items() >= expected.attrs.items()


def test_a_table_that_was_kept_is_written_again(table: Table, tmp_path: Path) -> None:
    """What comes back from Zarr is the table: it gives the same texture, bit for bit."""
    (path,) = write(table, tmp_path / "film.zarr")
    (first, *_) = write(opened(path), tmp_path / "back.exr")
    (second, *_) = write(table, tmp_path / "film.exr")
    assert first.read_bytes() == second.read_bytes()


def test_the_group_is_of_zarr_3_and_uses_what_its_specification_has(table: Table, tmp_path: Path) -> None:
    """Types that other languages read: the core's numbers, and the registered type string."""
    (path,) = write(table, tmp_path / "film.zarr")
    with zipfile.ZipFile(path) as archive:
        documents = [
            json.loads(archive.read(name)) for name in archive.namelist() if name.endswith("zarr.json")
        ]
    assert {document["zarr_format"] for document in documents} == {3}
    types = {document["data_type"] for document in documents if document["node_type"] == "array"}
    assert types == {"float32", "float64", "string"}


def test_unpacked_it_is_a_folder_store(table: Table, tmp_path: Path) -> None:
    """`unzip` makes of it what an object store holds."""
    (path,) = write(table, tmp_path / "film.zarr")
    with zipfile.ZipFile(path) as archive:
        archive.extractall(tmp_path / "folder")
    group = zarr.open_group(tmp_path / "folder", mode="r")
    np.testing.assert_array_equal(group["R_s"][:], table.values("R_s"))


def test_the_time_of_writing_is_not_in_the_file(table: Table, tmp_path: Path) -> None:
    """Equal tables are equal files, so that a store may know them by their SHA-256."""
    (path,) = write(table, tmp_path / "film.zarr")
    with zipfile.ZipFile(path) as archive:
        entries = archive.infolist()
    assert {entry.date_time for entry in entries} == {(1980, 1, 1, 0, 0, 0)}
    assert [entry.filename for entry in entries] == sorted(entry.filename for entry in entries)
    assert verify(path).sha256 == hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.mark.parametrize("edit", ["value", "unit"])
def test_an_edited_group_is_found(table: Table, tmp_path: Path, edit: str) -> None:
    """By xarray to a folder store, and packed again, as a user would; a unit is part of a value."""
    (path,) = write(table, tmp_path / "film.zarr")
    dataset = opened(path)
    if edit == "value":
        dataset["R_s"][0, 1, 2] *= 0.5
    else:
        dataset["Delta"].attrs["units"] = "deg"
    dataset.to_zarr(tmp_path / "folder", zarr_format=3, consolidated=False)
    Path(shutil.make_archive(str(tmp_path / "packed"), "zip", tmp_path / "folder")).replace(path)
    (problem,) = verify(path).problems
    assert problem.startswith("nacreous:checksum")


def test_a_chunk_that_is_gone_is_found(table: Table, tmp_path: Path) -> None:
    """Zarr reads a missing chunk as its fill value, and says nothing."""
    (path,) = write(table, tmp_path / "film.zarr")
    with zipfile.ZipFile(path) as archive:
        kept = {name: archive.read(name) for name in archive.namelist() if name != "R_s/c/0/0/0"}
        assert len(kept) == len(archive.namelist()) - 1
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in kept.items():
            archive.writestr(name, content)
    assert any("nacreous:checksum" in problem for problem in verify(path).problems)


def test_a_folder_is_not_replaced(table: Table, tmp_path: Path) -> None:
    """A folder store that someone unpacked under the name is not ours to delete."""
    (tmp_path / "film.zarr").mkdir()
    with pytest.raises(FileFormatError, match="it is a folder"):
        write(table, tmp_path / "film.zarr")


def test_zarr_is_imported_only_for_zarr() -> None:
    """Importing it takes longer than computing a lookup texture."""
    loaded = "sorted({'zarr', 'scipy', 'MaterialX', 'xarray'} & set(sys.modules))"
    code = f"import sys, nacreous.formats.registry; print({loaded})"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
