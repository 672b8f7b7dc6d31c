"""``csv``: the spectra as a tidy table, one row a sample, for spreadsheets and plotting programs.

Lines that begin with ``#`` hold the provenance, the last one the checksum of all the others;
``pandas.read_csv(path, comment="#")`` reads the rest.
Columns are ``thickness_scale, cos_theta, wavelength_nm, R_s, R_p, T_s, T_p``, and ``psi, Delta`` in radians
where the table has them; the wavelength changes fastest. Nine digits give every float32 back exactly, and
seventeen every float64 (IEEE 754-2008, section 5.12.2).
"""

from collections.abc import Iterable, Iterator
from io import StringIO
from pathlib import Path
from typing import TextIO

import numpy as np

from nacreous.errors import FileFormatError, reason
from nacreous.formats.atomic import replacing
from nacreous.formats.contents import CHECKSUM, Contents, checksum, labelled, provenance_of
from nacreous.formats.lookup import required
from nacreous.tables.table import Table

__all__ = ["SUFFIX", "read", "write"]

SUFFIX = ".csv"

_AXES = ("thickness_scale", "cos_theta", "wavelength_nm")
_FLUXES = ("R_s", "R_p", "T_s", "T_p")
_ELLIPSOMETRY = ("psi", "Delta")
_DIGITS = {4: 9, 8: 17}
"""Digits that tell all numbers apart, by their size in bytes."""


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write the spectra of `table` and return the file; raises `FileFormatError`."""
    names = [*_FLUXES, *(name for name in _ELLIPSOMETRY if name in table.variables)]
    values = np.stack([required(table, name) for name in names], axis=-1)  # (S, A, L, columns)
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
    yield ",".join((*_AXES, *names)) + "\n"
    for scale, at_scale in zip(table.values("thickness_scale").tolist(), values, strict=True):
        yield from _rows(table, scale, at_scale)


def _rows(table: Table, scale: float, values: np.ndarray) -> Iterator[str]:
    """Yield the lines of one thickness, values (A, L, columns)."""
    wavelengths = [f"{nm!r}," for nm in table.values("wavelength_nm").tolist()]
    row = ",".join([f"%.{_DIGITS[values.dtype.itemsize]}g"] * values.shape[-1]) + "\n"
    for cosine, at_cosine in zip(table.values("cos_theta").tolist(), values.tolist(), strict=True):
        start = f"{scale!r},{cosine!r},"
        yield from (start + nm + row % tuple(at) for nm, at in zip(wavelengths, at_cosine, strict=True))


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
    if tuple(names[:3]) != _AXES or len(lines) < 2:
        raise FileFormatError(f"expected the columns {', '.join(_AXES)}, … and rows, got neither")
    try:
        values = np.loadtxt(StringIO("\n".join(lines[1:])), delimiter=",", ndmin=2)
    except ValueError as error:
        raise FileFormatError(f"expected rows of numbers, got others: {error}") from error
    if values.shape[1] != len(names):
        raise FileFormatError(f"expected {len(names)} columns, got {values.shape[1]}")
    return dict(zip(names, values.T, strict=True))
