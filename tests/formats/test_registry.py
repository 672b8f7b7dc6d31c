"""The registry is complete, and picks the format that a file's name asks for."""

from collections.abc import Callable
from pathlib import Path

import pytest
import xarray

from nacreous.errors import FileFormatError, SpecError
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS, find_format, format_of, parts_of, write
from nacreous.formats.verify import verify
from nacreous.tables.sampling import Sampling
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part, Table

Held = Callable[[str], Table]


def test_every_name_has_a_format_of_its_own() -> None:
    """The command line offers the names, so each must lead somewhere."""
    assert list(FORMATS) == list(FormatName)
    assert len({entry.suffix for entry in FORMATS.values()}) == len(FORMATS)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("film.exr", "exr"),
        ("film.spectral.exr", "spectral-exr"),
        ("film.transmission.spectral.exr", "spectral-exr"),
        ("FILM.EXR", "exr"),
        ("film.nc", "netcdf"),
        ("film.v2.csv", "csv"),
        ("film.rgb.bsdf", "rgl-rgb"),
        ("film.pbsdf", "mueller"),
        ("film.mbsdf", "mbsdf"),
    ],
)
def test_the_longest_suffix_decides(name: str, expected: str) -> None:
    """A spectral EXR ends in .exr as well, and the case of a suffix says nothing."""
    assert format_of(Path("folder.npz", name)).name == expected


def test_an_unknown_suffix_or_name_is_refused_with_the_known_ones() -> None:
    """The message says what would have been right."""
    with pytest.raises(SpecError, match=r"\.spectral\.exr.*got .film\.tiff"):
        format_of(Path("film.tiff"))
    with pytest.raises(SpecError, match="did you mean netcdf"):
        find_format("netcfd")


def test_writes_what_xarray_holds(table: Table, tmp_path: Path) -> None:
    """A dataset is a table that has been to xarray and back: the same bytes."""
    write(table, tmp_path / "table.exr")
    write(table.to_xarray(), tmp_path / "dataset.exr")
    assert (tmp_path / "table.exr").read_bytes() == (tmp_path / "dataset.exr").read_bytes()


def test_a_format_by_name_needs_no_suffix(table: Table, tmp_path: Path) -> None:
    """What the user names wins over what the file is called."""
    write(table, tmp_path / "film.data", "npz")
    assert (tmp_path / "film.data").read_bytes()[:2] == b"PK"  # a zip archive (APPNOTE 4.3.7)


@pytest.mark.parametrize("name", FORMATS)
def test_what_is_written_is_good_and_the_same_every_time(held: Held, tmp_path: Path, name: str) -> None:
    """The same spec gives the same bytes, and every file that is returned passes `verify`."""
    check_written(held(name), tmp_path, name)


def check_written(table: Table, tmp_path: Path, name: str) -> None:
    """Write a table twice, and look at both."""
    suffix = FORMATS[FormatName(name)].suffix
    folders = tmp_path / "first", tmp_path / "second"  # of one name: a document holds that of its texture
    for folder in folders:
        folder.mkdir()
    first, second = (write(table, folder / f"film{suffix}") for folder in folders)
    for one, other in zip(first, second, strict=True):
        assert one.read_bytes() == other.read_bytes()
        assert verify(one).problems == ()
        assert verify(one).id == table.id


def test_asks_for_colours_only_where_there_are_any(one_thickness: Table, infrared: Table) -> None:
    """An npz takes what the spec has; an EXR lookup texture is nothing without colours."""
    npz, exr = FORMATS[FormatName.NPZ], FORMATS[FormatName.EXR]
    assert parts_of([npz], one_thickness.spec) == {Part.SPECTRUM, Part.COLOUR}
    assert parts_of([npz], infrared.spec) == {Part.SPECTRUM}
    assert parts_of([npz, exr], infrared.spec) == {Part.SPECTRUM, Part.COLOUR}


@pytest.mark.parametrize(
    "change",
    [
        lambda dataset: dataset.assign(R_s=dataset.R_s * 0.5),
        lambda dataset: dataset.sel(cos_theta=1),
        lambda dataset: dataset.isel(cos_theta=[0, 1]),
        lambda dataset: dataset.transpose(),
        lambda dataset: dataset.assign_coords(cos_theta=dataset.cos_theta * 0.5),
        lambda dataset: dataset.assign_attrs({"nacreous:certificate": "{}"}),
        lambda dataset: (dataset.drop_vars("channel") * 2).assign_attrs(dataset.attrs),
    ],
)
@pytest.mark.parametrize("suffix", [".exr", ".npz", ".nc", ".csv", ".zarr", ".mtlx", ".gltf"])
def test_a_dataset_that_was_changed_is_not_written(
    table: Table, tmp_path: Path, suffix: str, change: Callable[[xarray.Dataset], xarray.Dataset]
) -> None:
    """Its id and its certificate would be those of other values."""
    with pytest.raises(FileFormatError, match=r"changed since.*to_netcdf"):
        write(change(table.to_xarray()), tmp_path / f"film{suffix}")
    assert list(tmp_path.iterdir()) == []


def test_a_dataset_that_was_kept_is_written(table: Table, tmp_path: Path) -> None:
    """A table that comes back from a NetCDF file gives the same texture."""
    (path,) = write(table, tmp_path / "film.nc")
    back = xarray.load_dataset(path, engine="h5netcdf")
    first = write(back, tmp_path / "back.exr")
    second = write(table.to_xarray(), tmp_path / "film.exr")
    assert [file.read_bytes() for file in first] == [file.read_bytes() for file in second]


@pytest.mark.parametrize("other", [xarray.Dataset(), {"R_s": 1}, None])
def test_what_is_no_table_is_refused(tmp_path: Path, other: object) -> None:
    """The message says what is expected."""
    with pytest.raises(FileFormatError, match=r"expected a dataset as nacreous\.tabulate returns it"):
        write(other, tmp_path / "film.exr")


# ---- quantities --------------------------------------------------------------------------------------------

HELD = [
    (name, quantity)
    for quantity in ("albedo", "bsdf")
    for name, entry in FORMATS.items()
    if quantity in entry.quantities and entry.sampling is Sampling.AXES
]
"""Formats with the axes of a spec, and what else than a smooth film they hold."""


@pytest.mark.parametrize(("name", "quantity"), HELD)
def test_every_quantity_that_a_format_holds_is_good_and_the_same_every_time(
    request: pytest.FixtureRequest, tmp_path: Path, name: str, quantity: str
) -> None:
    """As for a smooth film: equal bytes, and nothing that `verify` finds wrong."""
    surface: Table = request.getfixturevalue(quantity)
    check_written(surface, tmp_path, name)


def test_a_format_that_cannot_hold_a_quantity_is_refused_before_it_is_computed(bsdf: Table) -> None:
    """The message names option, quantity and the formats that can; a spec is all it takes."""
    with pytest.raises(
        SpecError, match=r"bsdf tables \(exr, npz, netcdf, csv, png[^)]*\), got .spectral-exr"
    ) as refused:
        parts_of([FORMATS[FormatName.EXR], FORMATS[FormatName.SPECTRAL_EXR]], bsdf.spec)
    assert refused.value.field == "format"


def test_a_table_that_a_format_cannot_hold_is_not_written(bsdf: Table, tmp_path: Path) -> None:
    """The same refusal for who computes first and writes afterwards."""
    with pytest.raises(SpecError, match="bsdf"):
        write(bsdf, tmp_path / "film.spectral.exr")
    assert list(tmp_path.iterdir()) == []


def test_a_csv_ends_where_spreadsheets_do(bsdf: Table) -> None:
    """2 x 3 x 3 x 4 x 5 samples of 4 wavelengths fit; of 3,000 they are 1,080,000 rows, and do not."""
    chosen = [FORMATS[FormatName.CSV]]
    assert parts_of(chosen, bsdf.spec) == {Part.SPECTRUM}
    fields = bsdf.spec.model_dump(mode="json")
    fields["table"]["wavelength_nm"] = {"start": 390, "stop": 710, "count": 3000}
    with pytest.raises(SpecError, match=r"1,000,000 rows as csv, got 1,080,000; npz and netcdf hold it"):
        parts_of(chosen, Spec.from_document(fields))
    fields["table"] = {"wavelength_nm": {"start": 390, "stop": 710, "count": 60_000}, "cos_theta": 18}
    assert parts_of(chosen, Spec.from_document(fields)) == {Part.SPECTRUM}  # of a film, as ever


@pytest.mark.parametrize("quantity", ["albedo", "bsdf"])
def test_writes_what_xarray_holds_of_a_rough_surface(
    request: pytest.FixtureRequest, tmp_path: Path, quantity: str
) -> None:
    """Dimensions and their order survive the way to xarray and back."""
    surface: Table = request.getfixturevalue(quantity)
    test_writes_what_xarray_holds(surface, tmp_path)


@pytest.mark.parametrize(("name", "quantity"), HELD)
def test_computed_surfaces_are_good_in_every_format_that_holds_them(
    request: pytest.FixtureRequest, tmp_path: Path, name: str, quantity: str
) -> None:
    """Axes, id, certificate and energy are what `verify` expects of the spec."""
    computed: Table = request.getfixturevalue(f"computed_{quantity}")
    files = write(computed, tmp_path / f"film{FORMATS[FormatName(name)].suffix}")
    assert [verify(file).problems for file in files] == [()] * len(files)
