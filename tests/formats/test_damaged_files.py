"""Files that are damaged on purpose: `verify` says what it expected, and raises nothing."""

import json
import struct
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS, write
from nacreous.formats.verify import verify
from nacreous.tables.sampling import Sampling
from nacreous.tables.table import Table, Variable

Held = Callable[[str], Table]

BINARY = [FormatName.RGL_RGB, FormatName.MBSDF, FormatName.MUELLER, FormatName.MERL]
"""Formats whose bytes we read ourselves."""
NODES = ("phi_d", "theta_d", "theta_h")
_PLACES = 60
"""Bytes of a file's head, and as many anywhere, that are changed one at a time."""


@pytest.fixture
def file(request: pytest.FixtureRequest, held: Held, tmp_path: Path) -> Path:
    """Write a file of the format that the test names."""
    name: str = request.param
    return write(thinned(held(name)), tmp_path / f"film{FORMATS[FormatName(name)].suffix}")[0]


def thinned(table: Table) -> Table:
    """Return a table with a few of its nodes, where it is of Mueller matrices: each damage is a file read."""
    if table.sampling is not Sampling.MUELLER:
        return table

    def every_ninth(variable: Variable) -> Variable:
        few = tuple(slice(None, None, 9 if dim in NODES else 1) for dim in variable.dims)
        return replace(variable, values=np.ascontiguousarray(variable.values[few]))

    coords, variables = (
        {name: every_ninth(variable) for name, variable in held.items()}
        for held in (table.coords, table.variables)
    )
    return replace(table, coords=coords, variables=variables)


def places(size: int) -> list[int]:
    """Return bytes of the head and of the rest of a file."""
    random = np.random.default_rng(size)
    return sorted({*random.integers(0, min(1000, size), _PLACES), *random.integers(0, size, 8)})


@pytest.mark.parametrize("file", BINARY, indirect=True)
def test_any_byte_that_changes_is_found(file: Path) -> None:
    """Offsets of 2^63, names that are no text, counts beyond the file: one problem each, none raised."""
    data = file.read_bytes()
    for place in places(len(data)):
        damaged = bytearray(data)
        damaged[place] ^= 255
        file.write_bytes(damaged)
        assert verify(file).problems, place


@pytest.mark.parametrize("file", BINARY, indirect=True)
def test_what_is_appended_is_found(file: Path) -> None:
    """Nothing may follow what was written."""
    with file.open("ab") as end:
        end.write(b"\0" * 16)
    assert verify(file).problems


@pytest.mark.parametrize("file", [FormatName.MBSDF], indirect=True)
@pytest.mark.parametrize("head", [(1, 2**32 - 1, 2**32 - 1), (1, 2**20, 2**10)])
def test_a_block_larger_than_its_file_is_not_asked_for(file: Path, head: tuple[int, int, int]) -> None:
    """Memory is taken for what the file holds, not for what it claims."""
    data, line = file.read_bytes(), b"MBSDF_DATA_REFLECTION=\n"
    at = data.index(line) + len(line)
    file.write_bytes(data[:at] + struct.pack("<3I", *head) + data[at + 12 :])
    (problem,) = verify(file).problems
    assert "ends within its data" in problem


@pytest.mark.parametrize("file", [FormatName.MERL], indirect=True)
@pytest.mark.parametrize("value", [np.nan, -7.0, 0.5])
def test_a_bin_without_light_has_no_value(file: Path, value: float) -> None:
    """The last bin of a plane is below the surface: theta_h and theta_d of 90 degrees."""
    data = file.read_bytes()
    file.write_bytes(data[:-8] + struct.pack("<d", value))
    assert any("no light reaches" in problem for problem in verify(file).problems)


def test_documents_of_another_shape_are_found(tmp_path: Path) -> None:
    """Nested 20,000 deep, numbers of 400 digits, null where a group should be."""
    nested = "<materialx>" + "<a>" * 20_000 + "</a>" * 20_000 + "</materialx>"
    (tmp_path / "film.mtlx").write_text(nested)
    extras = {"film_rgb": [[10**400] * 3] * 3, "gltf_rgb": [], "delta_e_2000": [], "provenance": {}}
    (tmp_path / "film.gltf").write_text(json.dumps({"materials": [{"extras": {"nacreous": extras}}]}))
    with zipfile.ZipFile(tmp_path / "film.zarr", "w") as archive:
        archive.writestr("zarr.json", "null")
    (tmp_path / "deep.mbsdf").write_bytes(
        b"NVIDIA ARC MBSDF V1\nNACREOUS=" + b"[" * 100_000 + b"\nMBSDF_DATA_REFLECTION=\n"
    )
    for path in sorted(tmp_path.iterdir()):
        assert len(verify(path).problems) == 1, path
