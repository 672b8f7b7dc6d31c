"""The files of a table as the library keeps them: their keys, and what is known of each."""

import re
from collections.abc import Mapping
from importlib.metadata import version
from pathlib import Path
from types import MappingProxyType
from typing import Any

from nacreous.engine.work import File, Product, Work
from nacreous.errors import MissingError
from nacreous.formats.companion import ACCOMPANIED, TRANSMISSION
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS, Format, format_of
from nacreous.optics.value import shown
from nacreous.store.entry import Entry
from nacreous.tables.axes import wavelength_values_nm
from nacreous.tables.colour import has_colour
from nacreous.tables.spec import LABELS, Spec

__all__ = [
    "RECORD_SUFFIX",
    "SUFFIXES",
    "check_table_id",
    "default_format",
    "entries_of",
    "file_key",
    "format_of_suffix",
    "record_entry",
    "table_key",
]

RECORD_SUFFIX = ".spec"
"""What the key of a table's record ends in: its spec, and its certificate among the facts."""

_TABLE_ID = re.compile("[0-9a-f]{64}")
_DOCUMENT = FORMATS[FormatName.MATERIALX].suffix

_BY_SUFFIX: Mapping[str, Format] = MappingProxyType(
    {
        **{entry.suffix: entry for entry in FORMATS.values()},
        **{f"{TRANSMISSION}{entry.suffix}": entry for name, entry in FORMATS.items() if name in ACCOMPANIED},
    }
)
SUFFIXES = tuple(_BY_SUFFIX)
"""What the name of a table's file may end in."""


def default_format(spec: Spec) -> FormatName:
    """Return the format that a table is computed in first: exr where it has colour, else npz."""
    coloured = has_colour(wavelength_values_nm(spec.table.wavelength_nm))
    return FormatName.EXR if coloured else FormatName.NPZ


def check_table_id(table_id: str) -> None:
    """Raise `MissingError` for what cannot be the id of any table."""
    if not _TABLE_ID.fullmatch(table_id):
        raise MissingError("there is no such table: an id has 64 digits, 0 to 9 and a to f")


def table_key(table_id: str, suffix: str) -> str:
    """Return the key in the store of what is known of a table under a suffix."""
    return f"tables/{table_id[:2]}/{table_id}{suffix}"


def file_key(work: Work, suffix: str = "") -> str:
    """Return the key in the store of a file of a work; without `suffix` of the format's own.

    A MaterialX document names the texture beside it, so that there is one for each stem.
    """
    named = work.stem not in ("", work.id) and (suffix or work.target.suffix) == _DOCUMENT
    stem = f".{work.stem.replace('/', '-')}" if named else ""
    return table_key(work.id, f"{stem}{suffix or work.target.suffix}")


def format_of_suffix(suffix: str) -> Format:
    """Return the format that writes files of this suffix; raises `MissingError` with those that there are."""
    try:
        return _BY_SUFFIX[suffix]
    except KeyError:
        known = ", ".join(SUFFIXES)
        raise MissingError(f"expected a file name that ends in {known}, got {shown(suffix)}") from None


def entries_of(work: Work, product: Product) -> Mapping[str, Entry]:
    """Return the entries of a product by their suffixes, the format's own file last.

    What is stored last is there only if all that belongs to it is.
    """
    own = work.target.suffix
    ordered = sorted(product.files, key=lambda file: file.suffix == own)
    return {file.suffix: _entry(work, product, file) for file in ordered}


def _entry(work: Work, product: Product, file: File) -> Entry:
    written_as = work.target if file.suffix == work.target.suffix else format_of(Path("table" + file.suffix))
    alike = [each.suffix for each in product.files if each.suffix.endswith(written_as.suffix)]
    facts = {
        "id": product.id,
        "format": written_as.name.value,
        "suffix": file.suffix,
        "files": sorted([each.suffix for each in product.files] if written_as is work.target else alike),
        "media_type": written_as.media_type,
        "certificate": dict(product.certificate),
        "seconds": round(product.seconds, 4),
        "version": version("nacreous"),
    }
    return Entry(facts, file.payload)


def record_entry(spec: Spec, table_id: str, certificate: Mapping[str, Any]) -> Entry:
    """Return the entry of a table's record; a spec's labels are no part of it."""
    facts = {
        "id": table_id,
        "media_type": "application/json",
        "certificate": dict(certificate),
        "version": version("nacreous"),
    }
    return Entry(facts, spec.model_dump_json(exclude=set(LABELS)).encode())
