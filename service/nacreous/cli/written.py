"""What the command line says of a file that it has written, whoever computed it."""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

from nacreous.formats.registry import Format
from nacreous.formats.verify import file_sha256
from nacreous.tables.measured.certificate import shortfall

__all__ = ["Written", "by_sampling", "record", "warning"]


@dataclass(frozen=True)
class Written:
    """A file, the format that it was written as or with, and the id and the certificate of its table."""

    path: Path
    format: Format
    id: str
    certificate: Mapping[str, Any]


def by_sampling(formats: Sequence[Format]) -> Iterator[tuple[Format, ...]]:
    """Yield the formats that are written of one table, in the order in which each table is first wanted."""
    order = list(dict.fromkeys(chosen.sampling for chosen in formats))
    ordered = sorted(formats, key=lambda chosen: order.index(chosen.sampling))
    for _, alike in groupby(ordered, key=lambda chosen: chosen.sampling):
        yield tuple(alike)


def warning(formats: Sequence[Format], certificate: Mapping[str, Any]) -> str:
    """Say where a format's own grid is too coarse, as the certificate has it; nothing where it is not."""
    fault = shortfall(certificate)
    return f"nacreous: {', '.join(chosen.name for chosen in formats)}: {fault}" if fault else ""


def record(written: Written, seconds: float) -> str:
    """Return what a program wants to know of a file, as one line of JSON."""
    facts = {
        "path": str(written.path),
        "format": written.format.name,
        "id": written.id,
        "sha256": file_sha256(written.path),
        "seconds": round(seconds, 4),
        "certificate": written.certificate,
    }
    return json.dumps(facts, allow_nan=False)
