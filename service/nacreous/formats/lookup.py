"""The lookup texture: a table as a picture that a shader reads at (cos_theta, thickness_scale).

x is cos_theta from left to right, y is thickness_scale from the top row down, both ascending. Every texel is
a sample at the axis's own value, so the first and the last texel *centres* are the ends of the axis: a shader
reads at u = (x (N - 1) + 0.5) / N. A table of one thickness becomes two equal rows, so that it makes no
difference whether a renderer counts rows from the top or from the bottom.

Reflection and transmission are two files: an alpha channel would be multiplied into the colours.
"""

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import FileFormatError
from nacreous.formats.contents import Contents, labelled
from nacreous.tables.spec import ColourSpec
from nacreous.tables.table import Table

__all__ = [
    "axis_attribute",
    "colour_facts",
    "colour_quantities",
    "lookup_attributes",
    "lookup_files",
    "lookup_rows",
    "required",
]


def colour_quantities(table: Table) -> tuple[str, ...]:
    """Return the quantities whose colour the table holds: ``R``, and ``T`` where the substrate transmits.

    Raises
    ------
    FileFormatError
        The table holds no colours.
    """
    required(table, "R_rgb")
    return ("R", "T") if "T_rgb" in table.variables else ("R",)


def lookup_files(
    path: Path, suffix: str, quantities: Sequence[str], read: Callable[[Path], Contents]
) -> tuple[dict[str, Path], tuple[Path, ...]]:
    """Return the file of each quantity, ``film.exr`` for R and ``film.transmission.exr`` for T, and old ones.

    An old one is what an earlier table has left where this one has nothing to write: a stranger would take it
    for the transmission of this film. Files that are not Nacreous's, as `read` finds, are none of them.
    """
    stem, end = _split(path.name, suffix)
    files = {"R": path, "T": path.with_name(f"{stem}.transmission{end}")}
    obsolete = [
        file for quantity, file in files.items() if quantity not in quantities and _is_ours(file, read)
    ]
    return {quantity: files[quantity] for quantity in quantities}, tuple(obsolete)


def _is_ours(path: Path, read: Callable[[Path], Contents]) -> bool:
    try:
        return path.is_file() and "id" in read(path).provenance
    except (OSError, FileFormatError):
        return False


def _split(name: str, suffix: str) -> tuple[str, str]:
    """Split a file's name before `suffix`, or before its own last suffix where it ends otherwise."""
    length = len(suffix) if name.lower().endswith(suffix) else len(Path(name).suffix)
    return name[: len(name) - length], name[len(name) - length :]


def required(table: Table, name: str) -> NDArray[Any]:
    """Return the values of a variable; raises `FileFormatError` where the table was computed without it."""
    if name not in table.variables:
        known = ", ".join(table.variables)
        raise FileFormatError(f"expected a table with {name}, which the format holds, got {known}")
    return table.values(name)


def lookup_rows(values: NDArray[Any]) -> NDArray[np.float32]:
    """Return values over (thickness_scale, cos_theta, …) as float32 rows of texels, (H, W, …), H >= 2."""
    rows = np.asarray(values, np.float32)
    return np.repeat(rows, 2, axis=0) if len(rows) == 1 else rows


def lookup_attributes(table: Table, quantity: str) -> dict[str, str]:
    """Return what a picture's file says about itself: provenance, axes and colours."""
    scale = table.values("thickness_scale")
    facts = {
        "quantity": quantity,
        "axis.x": axis_attribute("cos_theta", table.values("cos_theta")),
        "axis.y": axis_attribute("thickness_scale", scale),
        **colour_facts(table.spec.colour),
    }
    return labelled({**table.provenance, **facts})


def colour_facts(colour: ColourSpec) -> dict[str, str]:
    """Return what a picture's file says of its colours."""
    return {
        "colour.space": colour.space,
        "colour.illuminant": colour.illuminant,
        "colour.observer": colour.observer,
    }


def axis_attribute(name: str, samples: NDArray[np.float64]) -> str:
    """Return the JSON that describes the axis of a picture; one sample has two texels."""
    values = np.repeat(samples, 2) if len(samples) == 1 else samples
    first, last = float(values[0]), float(values[-1])
    even = np.allclose(values, np.linspace(first, last, len(values)), rtol=0, atol=1e-9 * abs(last))
    axis: dict[str, Any] = {"name": name, "unit": "1", "range": [first, last], "count": len(values)}
    mapping = {"mapping": "linear"} if even else {"mapping": "explicit", "values": values.tolist()}
    return json.dumps(axis | mapping)
