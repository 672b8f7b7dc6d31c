"""``nacreous tabulate``: from a spec to files."""

import json
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

from nacreous.cli.arguments import AsJson, Assignments, Formats, OutputFolder, SpecOrPreset
from nacreous.formats.names import FormatName

if TYPE_CHECKING:
    from nacreous.formats.registry import Format
    from nacreous.tables.spec import Spec
    from nacreous.tables.table import Table

__all__ = ["tabulate"]


def tabulate(
    spec: SpecOrPreset,
    assignments: Assignments = None,
    formats: Formats = None,
    output: OutputFolder = Path(),
    *,
    as_json: AsJson = False,
) -> None:
    """Compute the table of a spec and write it.

    Prints the path of each file. Files are named after the spec's file or the preset. Without --format, the
    file is an EXR, the lookup texture for renderers.
    """
    from nacreous.cli.output import check_folder, file_stem
    from nacreous.formats.registry import FORMATS, check_name
    from nacreous.tables.presets import load

    began = perf_counter()
    check_folder(output)
    chosen = [FORMATS[name] for name in dict.fromkeys(formats or [FormatName.EXR])]
    for each in chosen:
        check_name(each, Path(file_stem(spec) + each.suffix))
    computed = list(_computed(load(spec, assignments or ()), chosen))  # all of them, before any is written
    output.mkdir(parents=True, exist_ok=True)
    for table, formats_of_it in computed:
        _warn(table, formats_of_it)
        for path, written_as in _written(table, formats_of_it, output / file_stem(spec)):
            print(_record(table, path, written_as, perf_counter() - began) if as_json else path, flush=True)


def _computed(spec: "Spec", formats: "Sequence[Format]") -> "Iterator[tuple[Table, tuple[Format, ...]]]":
    """Yield one table for each sampling, and the formats that it is written in."""
    from nacreous.cli.progress import progress
    from nacreous.formats.registry import parts_of
    from nacreous.tables.tabulate import tabulate_table

    parts_of(formats, spec)  # what a format cannot hold is refused before any is written
    for sampling in dict.fromkeys(chosen.sampling for chosen in formats):
        alike = tuple(chosen for chosen in formats if chosen.sampling is sampling)
        with progress("tabulating") as observer:
            table = tabulate_table(spec, parts_of(alike, spec), sampling=sampling, observer=observer)
        yield table, alike


def _warn(table: "Table", formats: "Sequence[Format]") -> None:
    """Say on stderr where a format's own grid is too coarse; the certificate has the figures."""
    from nacreous.tables.measured.certificate import shortfall

    if fault := shortfall(table.certificate):
        names = ", ".join(chosen.name for chosen in formats)
        print(f"nacreous: {names}: {fault}", file=sys.stderr)


def _written(table: "Table", formats: "Sequence[Format]", stem: Path) -> "Iterator[tuple[Path, Format]]":
    """Write the formats, and yield each file once: the texture of a MaterialX document is an EXR as well."""
    told: set[Path] = set()
    for chosen in formats:
        files = chosen.write(table, stem.with_name(stem.name + chosen.suffix))
        yield from ((path, chosen) for path in files if path not in told)
        told.update(files)


def _record(table: "Table", path: Path, written_as: "Format", seconds: float) -> str:
    """Return what a program wants to know of a file, as one line of JSON."""
    from nacreous.formats.verify import file_sha256

    record = {
        "path": str(path),
        "format": written_as.name,
        "id": table.id,
        "sha256": file_sha256(path),
        "seconds": round(seconds, 4),
        "certificate": table.certificate,
    }
    return json.dumps(record, allow_nan=False)
