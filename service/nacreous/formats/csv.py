"""``csv``: the spectra as a tidy table, one row a sample, for spreadsheets and plotting programs.

Lines that begin with ``#`` hold the provenance, the last one the checksum of all the others;
``pandas.read_csv(path, comment="#")`` reads the rest.
Columns are the axes of the table, then its values; the wavelength changes fastest. Nine digits give every
float32 back exactly, and seventeen every float64 (IEEE 754-2008, section 5.12.2).

========  ==================================================================================================
fresnel   ``thickness_scale, cos_theta, wavelength_nm, R_s, R_p, T_s, T_p``, and any ``psi, Delta`` in radians
albedo    ``roughness, thickness_scale, cos_theta, wavelength_nm, E_r, E_t``
bsdf      ``roughness, [phi_i,] theta_i, theta_o, phi, wavelength_nm, f_r, f_t``, up to a million rows
========  ==================================================================================================
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from io import StringIO
from itertools import product, takewhile
from pathlib import Path
from types import MappingProxyType
from typing import TextIO

import numpy as np

from nacreous.errors import FileFormatError, SpecError, reason
from nacreous.formats.atomic import replacing
from nacreous.formats.contents import CHECKSUM, Contents, checksum, labelled, provenance_of
from nacreous.formats.lookup import required
from nacreous.formats.spec_axes import AXES, spec_axes
from nacreous.tables.spec import Spec
from nacreous.tables.table import Table

__all__ = ["SUFFIX", "check", "read", "write"]

SUFFIX = ".csv"

_SPECTRA: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {"fresnel": ("R_s", "R_p", "T_s", "T_p"), "albedo": ("E_r", "E_t"), "bsdf": ("f_r", "f_t")}
)
_ELLIPSOMETRY = ("psi", "Delta")
_MOST_ROWS: Mapping[str, int] = MappingProxyType({"bsdf": 1_000_000})
"""Rows that a spreadsheet still opens: Excel and LibreOffice have 1,048,576."""
_DIGITS = {4: 9, 8: 17}
"""Digits that tell all numbers apart, by their size in bytes."""


def check(spec: Spec) -> None:
    """Refuse a spec whose table has more rows than a spreadsheet; raises `SpecError`."""
    quantity = spec.table.quantity
    rows = math.prod(axis.samples.size for axis in spec_axes(spec).values())
    most = _MOST_ROWS.get(quantity, rows)
    if rows > most:
        remedy = "npz and netcdf hold it, or choose fewer angles or wavelengths"
        raise SpecError("format", f"a {quantity} table of at most {most:,} rows as csv", f"{rows:,}", remedy)


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write the spectra of `table` and return the file; raises `FileFormatError`."""
    spectra = _SPECTRA[table.spec.table.quantity]
    names = [*spectra, *(name for name in _ELLIPSOMETRY if name in table.variables)]
    values = np.stack([required(table, name) for name in names], axis=-1)  # (…, L, columns)
    texts = {name: " ".join(text.split()) for name, text in labelled(table.provenance).items()}
    with replacing(path) as (temporary,), temporary.open("x", encoding="utf-8", newline="\n") as file:
        file.writelines(_comment(name, text) for name, text in texts.items())
        written = _written(file, _lines(table, names, values))
        file.write(_comment(CHECKSUM, checksum(texts.items(), written)))
    return (path,)


def _comment(name: str, text: str) -> str:
    return f"# {name} = {text}\n"


def _written(file: TextIO, lines: Iterable[str]) -> Iterator[bytes]:
    """Write lines, and yield each as it lies in the file."""
    for line in lines:
        file.write(line)
        yield line.encode()


def _lines(table: Table, names: list[str], values: np.ndarray) -> Iterator[str]:
    axes = table.variables[names[0]].dims
    yield ",".join((*axes, *names)) + "\n"
    *outer, wavelengths = ([f"{sample!r}," for sample in table.values(axis).tolist()] for axis in axes)
    row = ",".join([f"%.{_DIGITS[values.dtype.itemsize]}g"] * values.shape[-1]) + "\n"
    for start, spectra in zip(product(*outer), values.reshape(-1, *values.shape[-2:]), strict=True):
        before = "".join(start)
        samples = zip(wavelengths, spectra.tolist(), strict=True)
        yield from (before + nm + row % tuple(sample) for nm, sample in samples)


def read(path: Path) -> Contents:
    """Return the columns and the provenance; raises `FileFormatError`."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, ValueError) as error:
        raise FileFormatError(f"expected a csv file, got one that cannot be read: {reason(error)}") from error
    comments = [line.removeprefix("# ").partition(" = ") for line in lines if line.startswith("#")]
    table = [line for line in lines if not line.startswith("#")]
    columns = _columns(table)
    texts = [(name, text) for name, _, text in comments]
    found = checksum(texts, (f"{line}\n".encode() for line in table))
    return Contents(columns, provenance_of(texts), found)


def _columns(lines: list[str]) -> dict[str, np.ndarray]:
    names = lines[0].split(",") if lines else []
    axes = tuple(takewhile(AXES.__contains__, names))
    if axes[-1:] != ("wavelength_nm",) or len(lines) < 2:
        raise FileFormatError("expected columns such as cos_theta, wavelength_nm, R_s, … and rows, got none")
    try:
        values = np.loadtxt(StringIO("\n".join(lines[1:])), delimiter=",", ndmin=2)
    except ValueError as error:
        raise FileFormatError(f"expected rows of numbers, got others: {error}") from error
    if values.shape[1] != len(names):
        raise FileFormatError(f"expected {len(names)} columns, got {values.shape[1]}")
    return dict(zip(names, values.T, strict=True))
