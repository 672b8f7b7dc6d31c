"""``nacreous tabulate``: from a spec to files."""

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

import typer

from nacreous.cli.arguments import AsJson, Assignments, Formats, OutputFolder, SpecOrPreset
from nacreous.cli.server import server_of
from nacreous.formats.names import FormatName

if TYPE_CHECKING:
    from nacreous.cli.written import Written
    from nacreous.formats.registry import Format
    from nacreous.tables.spec import Spec
    from nacreous.tables.table import Table

__all__ = ["tabulate"]


def tabulate(
    context: typer.Context,
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
    from nacreous.cli.written import record
    from nacreous.formats.registry import FORMATS, check_name, parts_of
    from nacreous.tables.presets import load

    began = perf_counter()
    check_folder(output)
    chosen = [FORMATS[name] for name in dict.fromkeys(formats or [FormatName.EXR])]
    for each in chosen:
        check_name(each, Path(file_stem(spec) + each.suffix))
    film = load(spec, assignments or ())
    parts_of(chosen, film)  # what a format cannot hold is refused before any is written
    for written in _files(context, film, chosen, output / file_stem(spec)):
        line = record(written, perf_counter() - began) if as_json else written.path
        print(line, flush=True)


def _files(
    context: typer.Context, spec: "Spec", formats: "Sequence[Format]", stem: Path
) -> "Iterator[Written]":
    """Write the files, computed here or by a service, and yield each once it is there."""
    server = server_of(context)
    if server is None:
        yield from _computed_here(spec, formats, stem)
    else:
        from nacreous.cli.remote_tables import fetched_files

        yield from fetched_files(server, spec, formats, stem)


def _computed_here(spec: "Spec", formats: "Sequence[Format]", stem: Path) -> "Iterator[Written]":
    from nacreous.cli.written import Written, warning

    computed = list(_tables(spec, formats))  # all of them, before any is written
    stem.parent.mkdir(parents=True, exist_ok=True)
    for table, formats_of_it in computed:
        if fault := warning(formats_of_it, table.certificate):
            print(fault, file=sys.stderr)
        for path, written_as in _written(table, formats_of_it, stem):
            yield Written(path, written_as, table.id, table.certificate)


def _tables(spec: "Spec", formats: "Sequence[Format]") -> "Iterator[tuple[Table, tuple[Format, ...]]]":
    """Yield one table for each sampling, and the formats that it is written in."""
    from nacreous.cli.progress import progress
    from nacreous.cli.written import by_sampling
    from nacreous.formats.registry import parts_of
    from nacreous.tables.tabulate import tabulate_table

    for alike in by_sampling(formats):
        parts, sampling = parts_of(alike, spec), alike[0].sampling
        with progress("tabulating") as observer:
            table = tabulate_table(spec, parts, sampling=sampling, observer=observer)
        yield table, alike


def _written(table: "Table", formats: "Sequence[Format]", stem: Path) -> "Iterator[tuple[Path, Format]]":
    """Write the formats, and yield each file once: the texture of a MaterialX document is an EXR as well."""
    told: set[Path] = set()
    for chosen in formats:
        files = chosen.write(table, stem.with_name(stem.name + chosen.suffix))
        yield from ((path, chosen) for path in files if path not in told)
        told.update(files)
