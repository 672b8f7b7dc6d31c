"""The lookup texture: a table as pictures that a shader reads, `nacreous.formats.atlas` says where.

Reflection and transmission are two files: an alpha channel would be multiplied into the colours.
"""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import FileFormatError
from nacreous.formats.atlas import LAYOUTS, table_atlas
from nacreous.formats.companion import TRANSMISSION
from nacreous.formats.contents import Contents, labelled
from nacreous.tables.spec import ColourSpec
from nacreous.tables.table import Table

__all__ = [
    "colour_facts",
    "coloured_names",
    "colours",
    "is_of",
    "lookup_attributes",
    "lookup_files",
    "required",
]


def coloured_names(table: Table) -> tuple[str, ...]:
    """Return the parts whose colour the table holds: such as ``R``, and ``T`` where the substrate transmits.

    Raises
    ------
    FileFormatError
        The table holds no colours.
    """
    reflected, transmitted = LAYOUTS[table.spec.table.quantity].names
    required(table, f"{reflected}_rgb")
    return (reflected, transmitted) if f"{transmitted}_rgb" in table.variables else (reflected,)


def lookup_files(
    table: Table, path: Path, suffix: str, names: Sequence[str], read: Callable[[Path], Contents]
) -> tuple[dict[str, Path], tuple[Path, ...]]:
    """Return the file of each of `names`, and old ones.

    ``film.exr`` is of the reflected and ``film.transmission.exr`` of the transmitted part. An old one is what
    an earlier table has left where this one has nothing to write: a stranger would take it for the
    transmission of this film. Files that are not Nacreous's, as `read` finds, are none of them.
    """
    stem, end = _split(path.name, suffix)
    reflected, transmitted = LAYOUTS[table.spec.table.quantity].names
    files = {reflected: path, transmitted: path.with_name(f"{stem}{TRANSMISSION}{end}")}
    obsolete = [file for name, file in files.items() if name not in names and is_of(name, file, read)]
    return {name: files[name] for name in names}, tuple(obsolete)


def is_of(name: str, path: Path, read: Callable[[Path], Contents]) -> bool:
    """Tell whether a file is one of Nacreous's that holds the quantity `name`."""
    try:
        return path.is_file() and read(path).provenance.get("quantity") == name
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


def colours(table: Table, name: str) -> NDArray[np.float32]:
    """Return the colours of a part, such as ``R`` or ``E_t``, as texels, (H, W, 3)."""
    values = required(table, f"{name}_rgb")
    return table_atlas(table).picture(values, table.variables[f"{name}_rgb"].dims)


def lookup_attributes(table: Table, name: str) -> dict[str, str]:
    """Return what the file of a part says about itself: provenance, axes and colours."""
    facts = {"quantity": name, **table_atlas(table).attributes(), **colour_facts(table.spec.colour)}
    return labelled({**table.provenance, **facts})


def colour_facts(colour: ColourSpec) -> dict[str, str]:
    """Return what a picture's file says of its colours."""
    return {
        "colour.space": colour.space,
        "colour.illuminant": colour.illuminant,
        "colour.observer": colour.observer,
    }
