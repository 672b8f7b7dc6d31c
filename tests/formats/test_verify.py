"""Every lie that a file can tell is found: files are changed by other programs' libraries, then verified."""

import hashlib
import json
from pathlib import Path

import numpy as np
import OpenEXR
import pytest

from nacreous.formats.registry import FORMATS, write
from nacreous.formats.verify import verify
from nacreous.tables.table import Table


def changed_npz(table: Table, path: Path, **arrays: np.ndarray) -> Path:
    """Write a table as npz, with some arrays replaced."""
    write(table, path)
    with np.load(path) as archive:
        np.savez(path, **{**archive, **arrays})
    return path


def changed_exr(table: Table, path: Path, **attributes: str | None) -> Path:
    """Write a table as EXR, with some attributes replaced or, for None, removed."""
    write(table, path)
    with OpenEXR.File(str(path), separate_channels=True) as file:
        header = dict(file.header()) | {f"nacreous:{key}": value for key, value in attributes.items()}
        kept = {key: value for key, value in header.items() if value is not None and key != "channels"}
        planes = {name: np.array(channel.pixels) for name, channel in file.channels().items()}
    with OpenEXR.File(kept, planes) as file:
        file.write(str(path))
    return path


def test_a_good_file_is_described(table: Table, tmp_path: Path) -> None:
    """Checksum (FIPS 180-4, as hashlib has it), shape, count, range and provenance."""
    path = tmp_path / "film.exr"
    write(table, path)
    found = verify(path)
    assert found.good
    assert found.format == "exr"
    assert found.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()
    assert found.shapes == ("R_rgb 5x9x3",)
    assert found.values == found.finite == 5 * 9 * 3
    assert found.least == table.values("R_rgb").min()
    assert found.largest == table.values("R_rgb").max()
    assert (found.id, found.version) == (table.id, table.provenance["version"])


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_finds_what_is_not_finite(table: Table, tmp_path: Path, bad: float) -> None:
    """No passive film has an infinite reflectance."""
    R_s = table.values("R_s").copy()
    R_s[0, 1, 2] = bad
    found = verify(changed_npz(table, tmp_path / "film.npz", R_s=R_s))
    assert "R_s: expected finite values, got 1 that are not" in found.problems
    assert found.values - found.finite == 1


def test_finds_a_share_beyond_one(table: Table, tmp_path: Path) -> None:
    """A passive film reflects at most what falls on it."""
    found = verify(changed_npz(table, tmp_path / "film.npz", R_p=table.values("R_p") + np.float32(0.5)))
    assert any(problem.startswith("R_p: expected a share from 0 to 1") for problem in found.problems)


def test_finds_energy_from_nowhere(table: Table, tmp_path: Path) -> None:
    """R + T <= 1 for each polarisation, even where R and T are possible on their own."""
    half = np.full_like(table.values("R_s"), 0.6)
    found = verify(changed_npz(table, tmp_path / "film.npz", R_s=half, T_s=half))
    assert found.problems == ("R_s + T_s: expected at most 1, got 1.2",)


def test_finds_an_id_that_is_not_the_specs(table: Table, tmp_path: Path) -> None:
    """The id is a hash over the spec: nobody can change one without the other."""
    spec = json.loads(table.provenance["spec"])
    spec["stack"]["layers"][0]["thickness_nm"] = 421.0
    found = verify(changed_exr(table, tmp_path / "film.exr", spec=json.dumps(spec)))
    assert len(found.problems) == 1
    assert "the id of the file's spec" in found.problems[0]


def test_labels_may_change(table: Table, tmp_path: Path) -> None:
    """A name is for people and not part of the id."""
    spec = json.loads(table.provenance["spec"]) | {"name": "another name"}
    assert verify(changed_exr(table, tmp_path / "film.exr", spec=json.dumps(spec))).good


def test_cannot_know_the_id_of_other_kernels(table: Table, tmp_path: Path) -> None:
    """A file of another version is not bad for it: its id cannot be computed here."""
    assert verify(changed_exr(table, tmp_path / "film.exr", kernels="0" * 64, id="1" * 64)).good


@pytest.mark.parametrize(
    ("attributes", "problem"),
    [
        ({"id": None}, "nacreous:id, got none"),
        ({"id": "../../etc/passwd"}, "64 hexadecimal digits"),
        ({"spec": "{"}, "nacreous:spec"),
        ({"certificate": "none"}, "nacreous:certificate"),
        ({"axis.x": '{"count": 8}'}, "axis.x: expected 9 texels as R_rgb has, got 8"),
        ({"axis.y": "[]"}, "nacreous:axis.y"),
    ],
)
def test_finds_provenance_that_does_not_hold(
    table: Table, tmp_path: Path, attributes: dict[str, str | None], problem: str
) -> None:
    """Each attribute that the contract promises is looked at, whatever it holds."""
    found = verify(changed_exr(table, tmp_path / "film.exr", **attributes))
    assert any(problem in message for message in found.problems)


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize("share", [0.0, 0.02, 0.5, 0.97])
def test_finds_a_file_cut_short(table: Table, tmp_path: Path, name: str, share: float) -> None:
    """What a broken copy leaves: one problem, no traceback."""
    path = tmp_path / f"film{FORMATS[name].suffix}"
    write(table, path)
    path.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])
    assert verify(path).problems != ()


@pytest.mark.parametrize("name", FORMATS)
def test_finds_a_file_that_is_something_else(tmp_path: Path, name: str) -> None:
    """A suffix alone makes no table."""
    path = tmp_path / f"film{FORMATS[name].suffix}"
    path.write_bytes(bytes(range(256)) * 16)
    assert len(verify(path).problems) == 1


def test_answers_for_what_is_no_file(tmp_path: Path) -> None:
    """A folder, a name that is not there, and a suffix that nobody knows."""
    (tmp_path / "film.tiff").touch()
    assert "No such file" in verify(tmp_path / "absent.exr").problems[0]
    assert "directory" in verify(tmp_path).problems[0]
    assert "expected a file name that ends in" in verify(tmp_path / "film.tiff").problems[0]
