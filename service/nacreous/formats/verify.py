"""Whether a file is what it says: readable, finite, within the laws of energy, and of known origin."""

import hashlib
import json
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from nacreous.errors import NacreousError, reason
from nacreous.formats.contents import Contents, reading
from nacreous.formats.registry import format_of
from nacreous.formats.verify_laws import (
    check_densities,
    check_energy,
    check_finite,
    check_shares,
    quantities,
)
from nacreous.formats.verify_provenance import check_provenance, foreign_kernels
from nacreous.optics.value import shown

__all__ = ["Verification", "file_sha256", "verify"]


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
        with reading(f"a file of format {chosen.name}"), np.errstate(all="ignore"):
            return _examined(file, chosen.name, checksum, chosen.read(file))
    except NacreousError as error:
        return Verification(file, sha256=checksum, problems=(str(error),))


def _examined(path: Path, name: str, checksum: str, contents: Contents) -> Verification:
    found = quantities(contents)
    numbers = np.concatenate([np.empty(0), *map(np.ravel, found.values())]).astype(np.float64)
    finite = numbers[np.isfinite(numbers)]
    return Verification(
        path=path,
        format=name,
        sha256=checksum,
        id=contents.provenance.get("id", ""),
        version=contents.provenance.get("version", ""),
        shapes=tuple(f"{key} {'x'.join(map(str, array.shape))}" for key, array in found.items()),
        values=numbers.size,
        finite=finite.size,
        least=float(finite.min()) if finite.size else np.nan,
        largest=float(finite.max()) if finite.size else np.nan,
        problems=tuple(problem for check in _CHECKS for problem in check(contents)),
        notes=("computed by other kernels, so its id cannot be checked",)
        if foreign_kernels(contents)
        else (),
    )


# ---- one check each ----------------------------------------------------------------------------------------


def _check_texels(contents: Contents) -> Iterator[str]:
    """Compare a picture's size with the axes and tiles that its attributes describe."""
    for direction, side in enumerate("yx"):
        described = [key for key in (f"axis.{side}", f"tiles.{side}") if key in contents.provenance]
        if described:
            yield from _check_side(contents, direction, described)


def _check_side(contents: Contents, direction: int, described: Sequence[str]) -> Iterator[str]:
    counts = [_count(contents.provenance[key]) for key in described]
    expected = None if None in counts else math.prod(count for count in counts if count is not None)
    for name, array in quantities(contents).items():
        texels = array.shape[direction]
        if texels != expected:
            attributes = " times ".join(f"nacreous:{key}" for key in described)
            yield f"{attributes}: expected {texels} texels as {name} has, got {expected}"


def _count(axis: str) -> int | None:
    """Return the number that the JSON of an axis, or of tiles, says; None where it says none."""
    try:
        count = json.loads(axis)["count"]
    except (ValueError, KeyError, TypeError, RecursionError):
        return None
    return count if isinstance(count, int) else None


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
    check_finite,
    check_shares,
    check_densities,
    check_energy,
    _check_texels,
    check_provenance,
)
