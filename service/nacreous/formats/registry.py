"""Every format that Nacreous writes, in one immutable registry.

A new format is a module with `SUFFIX`, `write` and `read`, a name in `nacreous.formats.names`, and an entry
here.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from nacreous.errors import SpecError
from nacreous.formats import (
    csv,
    exr,
    gltf,
    materialx,
    mbsdf,
    merl,
    mueller,
    netcdf,
    npz,
    png,
    rgl,
    spectral_exr,
    zarr,
)
from nacreous.formats.atlas import LAYOUTS
from nacreous.formats.contents import Contents
from nacreous.formats.names import FormatName
from nacreous.optics.value import did_you_mean, shown
from nacreous.tables.axes import wavelength_values_nm
from nacreous.tables.colour import has_colour
from nacreous.tables.sampling import Sampling
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part, Table
from nacreous.tables.tabulate import tabulate_table

if TYPE_CHECKING:
    import xarray

__all__ = [
    "FORMATS",
    "Format",
    "check_holds",
    "check_name",
    "find_format",
    "format_of",
    "parts_of",
    "sampled_for",
    "write",
]

_COLOUR = frozenset({Part.COLOUR})
_SPECTRUM = frozenset({Part.SPECTRUM})
_BOTH = _COLOUR | _SPECTRUM
_NOTHING = frozenset[Part]()
_BSDF = frozenset({"bsdf"})


def _accept(_: Spec) -> None:
    """Refuse no spec."""


@dataclass(frozen=True)
class Format:
    """A file format.

    Parameters
    ----------
    name : FormatName
    suffix : str
        What the file's name ends in.
    holds : frozenset of Part
        What of a table the file holds, where the table has it.
    needs : frozenset of Part
        Without which there is no such file.
    media_type : str
    write : callable
        Writes a table to a path, all or nothing, and returns every file; raises `FileFormatError`.
    read : callable
        Reads a file that `write` wrote; raises `FileFormatError`.
    quantities : frozenset of str
        Of which quantities the file can be.
    check : callable
        Refuses a spec of such a quantity whose table the file cannot hold; raises `SpecError`.
    sampling : Sampling
        Where the table of the file is sampled. One whose readers fix that holds no parts of another.
    """

    name: FormatName
    suffix: str
    holds: frozenset[Part]
    needs: frozenset[Part]
    media_type: str
    write: Callable[[Table, Path], tuple[Path, ...]]
    read: Callable[[Path], Contents]
    quantities: frozenset[str] = frozenset(LAYOUTS)
    check: Callable[[Spec], None] = _accept
    sampling: Sampling = Sampling.AXES


_ALL = (
    Format(
        FormatName.EXR,
        exr.SUFFIX,
        _COLOUR,
        _COLOUR,
        "image/x-exr",
        exr.write,
        exr.read,
    ),
    Format(
        FormatName.SPECTRAL_EXR,
        spectral_exr.SUFFIX,
        _BOTH,
        _SPECTRUM,
        "image/x-exr",
        spectral_exr.write,
        spectral_exr.read,
        quantities=spectral_exr.QUANTITIES,
    ),
    Format(
        FormatName.NPZ,
        npz.SUFFIX,
        _BOTH,
        _SPECTRUM,
        "application/x-npz",
        npz.write,
        npz.read,
    ),
    Format(
        FormatName.NETCDF,
        netcdf.SUFFIX,
        _BOTH,
        _SPECTRUM,
        "application/x-netcdf",
        netcdf.write,
        netcdf.read,
    ),
    Format(
        FormatName.CSV,
        csv.SUFFIX,
        _SPECTRUM,
        _SPECTRUM,
        "text/csv",
        csv.write,
        csv.read,
        check=csv.check,
    ),
    Format(
        FormatName.PNG,
        png.SUFFIX,
        _COLOUR,
        _COLOUR,
        "image/png",
        png.write,
        png.read,
    ),
    Format(
        FormatName.RGL,
        rgl.SUFFIX,
        _NOTHING,
        _NOTHING,
        "application/octet-stream",
        rgl.write,
        rgl.read,
        quantities=_BSDF,
        check=rgl.check,
        sampling=Sampling.RGL_SPECTRA,
    ),
    Format(
        FormatName.RGL_RGB,
        rgl.COLOUR_SUFFIX,
        _NOTHING,
        _NOTHING,
        "application/octet-stream",
        rgl.write_colours,
        rgl.read_colours,
        quantities=_BSDF,
        check=rgl.check_colours,
        sampling=Sampling.RGL_COLOURS,
    ),
    Format(
        FormatName.MERL,
        merl.SUFFIX,
        _NOTHING,
        _NOTHING,
        "application/octet-stream",
        merl.write,
        merl.read,
        quantities=_BSDF,
        check=merl.check,
        sampling=Sampling.MERL,
    ),
    Format(
        FormatName.MBSDF,
        mbsdf.SUFFIX,
        _NOTHING,
        _NOTHING,
        "application/octet-stream",
        mbsdf.write,
        mbsdf.read,
        quantities=_BSDF,
        check=mbsdf.check,
        sampling=Sampling.MBSDF,
    ),
    Format(
        FormatName.MUELLER,
        mueller.SUFFIX,
        _NOTHING,
        _NOTHING,
        "application/octet-stream",
        mueller.write,
        mueller.read,
        quantities=_BSDF,
        check=mueller.check,
        sampling=Sampling.MUELLER,
    ),
    Format(
        FormatName.ZARR,
        zarr.SUFFIX,
        _BOTH,
        _SPECTRUM,
        "application/zip",
        zarr.write,
        zarr.read,
    ),
    Format(
        FormatName.MATERIALX,
        materialx.SUFFIX,
        _COLOUR,
        _COLOUR,
        "application/mtlx+xml",
        materialx.write,
        materialx.read,
        quantities=materialx.QUANTITIES,
        check=materialx.check,
    ),
    Format(
        FormatName.GLTF,
        gltf.SUFFIX,
        _COLOUR,
        _COLOUR,
        "model/gltf+json",
        gltf.write,
        gltf.read,
        quantities=gltf.QUANTITIES,
        check=gltf.check,
    ),
)

FORMATS: Mapping[FormatName, Format] = MappingProxyType({entry.name: entry for entry in _ALL})
"""Every format by name."""


def find_format(name: str) -> Format:
    """Return the format of this name; raises `SpecError`."""
    try:
        return FORMATS[FormatName(name)]
    except ValueError:
        remedy = did_you_mean(name, FORMATS)
        raise SpecError("format", f"one of {', '.join(FORMATS)}", shown(name), remedy) from None


def format_of(path: Path) -> Format:
    """Return the format whose suffix the file's name ends in, the longest that fits; raises `SpecError`."""
    fitting = [entry for entry in _ALL if path.name.lower().endswith(entry.suffix)]
    if not fitting:
        suffixes = ", ".join(entry.suffix for entry in _ALL)
        raise SpecError("", f"a file name that ends in {suffixes}", shown(path.name))
    return max(fitting, key=lambda entry: len(entry.suffix))


def check_name(chosen: Format, path: Path) -> None:
    """Refuse a name of another format's files, such as film.spectral.exr for exr; raises `SpecError`."""
    claimed = [entry for entry in _ALL if path.name.lower().endswith(entry.suffix)]
    longest = max(claimed, key=lambda entry: len(entry.suffix), default=chosen)
    if longest is not chosen and chosen in claimed:
        expected = f"a name that is not one of format {longest.name}, for a file of format {chosen.name}"
        raise SpecError("", expected, shown(path.name), f"leave {longest.suffix} out of the name")


def check_holds(chosen: Format, spec: Spec) -> None:
    """Refuse a format that cannot hold the table of `spec`; raises `SpecError` with those that can."""
    quantity = spec.table.quantity
    if quantity not in chosen.quantities:
        able = ", ".join(entry.name for entry in _ALL if quantity in entry.quantities)
        held = " or ".join(f'"{name}"' for name in sorted(chosen.quantities))
        remedy = f"{chosen.name} is for table.quantity = {held}"
        raise SpecError("format", f"one that holds {quantity} tables ({able})", f'"{chosen.name}"', remedy)
    chosen.check(spec)


def parts_of(formats: Sequence[Format], spec: Spec) -> frozenset[Part]:
    """Return what has to be computed of `spec`: all that the formats hold, or need where it has no colour.

    Raises
    ------
    SpecError
        A format cannot hold the table of `spec`.
    """
    for entry in formats:
        check_holds(entry, spec)
    coloured = has_colour(wavelength_values_nm(spec.table.wavelength_nm))
    parts = [entry.holds if coloured else entry.needs for entry in formats]
    return frozenset[Part]().union(*parts)


def write(
    table: "Table | xarray.Dataset",
    path: str | Path,
    format: str | None = None,  # noqa: A002 - the word that numpy, xarray and Pillow use for it
) -> tuple[Path, ...]:
    """Write a table to a file.

    Parameters
    ----------
    table : Table or xarray.Dataset
        As `nacreous.tabulate` returns it.
    path : str or Path
    format : str, optional
        Name of a format; without one it follows from the suffix of `path`.

    A format whose readers fix the directions has them computed from the table's spec.

    Returns
    -------
    tuple of Path
        Every file written: `path`, and for pictures of a transparent stack its ``.transmission`` companion.

    Raises
    ------
    SpecError
        There is no such format, none has this suffix, or the format cannot hold a table of this quantity.
    FileFormatError
        The table lacks what the format holds, or the file cannot be written. No file has changed.
    """
    target = Path(path)
    chosen = format_of(target) if format is None else find_format(format)
    given = table if isinstance(table, Table) else Table.from_xarray(table)
    check_holds(chosen, given.spec)
    check_name(chosen, target)
    return chosen.write(sampled_for(chosen, given), target)


def sampled_for(chosen: Format, table: Table) -> Table:
    """Return the table, or where the readers of the format want other samples the same spec's at these."""
    if chosen.sampling is table.sampling:
        return table
    return tabulate_table(table.spec, parts_of([chosen], table.spec), sampling=chosen.sampling)
