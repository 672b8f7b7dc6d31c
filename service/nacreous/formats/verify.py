"""Whether a file is what it says: readable, finite, within the laws of energy, and of known origin."""

import hashlib
import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from nacreous.errors import NacreousError, reason
from nacreous.formats.contents import Contents
from nacreous.formats.registry import format_of
from nacreous.formats.verify_provenance import AXES, check_provenance, foreign_kernels
from nacreous.optics.value import shown

__all__ = ["Verification", "file_sha256", "verify"]

_FLUXES = ("R_s", "R_p", "T_s", "T_p", "R", "T")
"""Shares of the incident flux; colours and angles may be negative."""
_LEAST, _LARGEST = -1e-6, 1 + 2e-5
"""What single precision makes of a flux of 0 and 1 at worst."""
_PAIRS = (("R_s", "T_s"), ("R_p", "T_p"))


@dataclass(frozen=True)
class Verification:
    """What was found in a file.

    Parameters
    ----------
    path : Path
    format : str
        Name of its format; empty where it has none of ours.
    sha256 : str
        Checksum of the whole file, in hex; empty where it cannot be read.
    id, version : str
        Id of the table, and the version of Nacreous that wrote it.
    shapes : tuple of str
        Each array as ``R_rgb 2x256x3``.
    values, finite : int
        Numbers in the file, and how many of them are finite.
    least, largest : float
        Range of the finite ones, over everything but the axes; NaN where there is none.
    problems : tuple of str
        What is wrong; empty for a good file.
    notes : tuple of str
        What is worth knowing and not wrong.
    """

    path: Path
    format: str = ""
    sha256: str = ""
    id: str = ""
    version: str = ""
    shapes: tuple[str, ...] = ()
    values: int = 0
    finite: int = 0
    least: float = np.nan
    largest: float = np.nan
    problems: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def good(self) -> bool:
        """Whether nothing is wrong."""
        return not self.problems


def file_sha256(path: Path) -> str:
    """Return the SHA-256 of a file, in hex."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def verify(path: str | Path) -> Verification:
    """Read a file that Nacreous wrote, and say what it holds and what is wrong with it.

    Nothing is raised for a bad file: whatever is found is in the answer.
    """
    file = Path(path)
    try:
        checksum = file_sha256(file)
    except OSError as error:
        return Verification(file, problems=(f"expected a file, got: {reason(error)}",))
    try:
        chosen = format_of(file)
        contents = chosen.read(file)
    except NacreousError as error:
        return Verification(file, sha256=checksum, problems=(str(error),))
    return _examined(file, chosen.name, checksum, contents)


def _examined(path: Path, name: str, checksum: str, contents: Contents) -> Verification:
    quantities = _quantities(contents)
    numbers = np.concatenate([np.empty(0), *map(np.ravel, quantities.values())]).astype(np.float64)
    finite = numbers[np.isfinite(numbers)]
    return Verification(
        path=path,
        format=name,
        sha256=checksum,
        id=contents.provenance.get("id", ""),
        version=contents.provenance.get("version", ""),
        shapes=tuple(f"{key} {'x'.join(map(str, array.shape))}" for key, array in quantities.items()),
        values=numbers.size,
        finite=finite.size,
        least=float(finite.min()) if finite.size else np.nan,
        largest=float(finite.max()) if finite.size else np.nan,
        problems=tuple(problem for check in _CHECKS for problem in check(contents)),
        notes=("computed by other kernels, so its id cannot be checked",)
        if foreign_kernels(contents)
        else (),
    )


def _quantities(contents: Contents) -> dict[str, np.ndarray]:
    return {
        name: array
        for name, array in contents.arrays.items()
        if name not in AXES and array.dtype.kind in "biuf" and array.size
    }


# ---- one check each ----------------------------------------------------------------------------------------


def _check_finite(contents: Contents) -> Iterator[str]:
    for name, array in _quantities(contents).items():
        bad = int(np.count_nonzero(~np.isfinite(array)))
        if bad:
            yield f"{name}: expected finite values, got {bad} that are not"


def _check_fluxes(contents: Contents) -> Iterator[str]:
    quantities = _quantities(contents)
    for name in quantities.keys() & set(_FLUXES):
        least, largest = np.fmin.reduce(quantities[name], None), np.fmax.reduce(quantities[name], None)
        if least < _LEAST or largest > _LARGEST:
            yield f"{name}: expected a share from 0 to 1, got {least:.6g} to {largest:.6g}"


def _check_energy(contents: Contents) -> Iterator[str]:
    for R, T in _PAIRS:
        r, t = (_quantities(contents).get(name, np.zeros(1)) for name in (R, T))
        if r.shape == t.shape:
            largest = np.fmax.reduce(r + t, None)
            if largest > _LARGEST:
                yield f"{R} + {T}: expected at most 1, got {largest:.6g}"


def _check_texels(contents: Contents) -> Iterator[str]:
    """Compare a picture's size with the axes that its attributes describe."""
    for direction, name in enumerate(("axis.y", "axis.x")):
        if name not in contents.provenance:
            continue
        count = _count(contents.provenance[name])
        for quantity, array in _quantities(contents).items():
            texels = array.shape[direction]
            if texels != count:
                yield f"nacreous:{name}: expected {texels} texels as {quantity} has, got {count}"


def _count(axis: str) -> object:
    """Return the number of texels that the JSON of an axis says; None where it says none."""
    try:
        return json.loads(axis)["count"]
    except (ValueError, KeyError, TypeError, RecursionError):
        return None


def _check_checksum(contents: Contents) -> Iterator[str]:
    """Compare what the file holds with what was written; a file without a checksum is told elsewhere."""
    claimed = contents.provenance.get("checksum", contents.checksum)
    if claimed != contents.checksum:
        yield (
            "nacreous:checksum: expected that of the values and attributes as they are, "
            f"{contents.checksum}, got {shown(claimed)}: the file has been changed"
        )


_CHECKS: tuple[Callable[[Contents], Iterator[str]], ...] = (
    _check_checksum,
    _check_finite,
    _check_fluxes,
    _check_energy,
    _check_texels,
    check_provenance,
)
