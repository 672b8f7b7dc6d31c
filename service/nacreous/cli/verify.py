"""``nacreous verify``: whether files are what they say."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from nacreous.cli.arguments import AsJson
from nacreous.cli.exit_codes import FAILED

if TYPE_CHECKING:
    from nacreous.formats.verify import Verification

__all__ = ["verify"]


def verify(
    files: Annotated[list[Path], typer.Argument(metavar="FILE…", help="Files that Nacreous wrote.")],
    *,
    as_json: AsJson = False,
) -> None:
    """Check files that Nacreous wrote.

    Looks at checksum, finite values, energy and provenance: a file that was changed after it was written is
    bad. Prints one line a file, and ends with 1 if any is bad.
    """
    from nacreous.cli.listing import print_json_lines
    from nacreous.formats.verify import verify as examine

    bad = 0
    for file in files:
        with _silent():
            found = examine(file)
        bad += not found.good
        if as_json:
            print_json_lines([_record(found)])
        else:
            print(_line(found))
    if bad:
        raise typer.Exit(FAILED)


@contextmanager
def _silent() -> Iterator[None]:
    """Keep what C libraries write of damaged files, past Python, off stdout and stderr."""
    sys.stdout.flush()
    kept = [(descriptor, os.dup(descriptor)) for descriptor in (1, 2)]
    try:
        with Path(os.devnull).open("w") as nothing:
            for descriptor, _ in kept:
                os.dup2(nothing.fileno(), descriptor)
        yield
    finally:
        for descriptor, copy in kept:
            os.dup2(copy, descriptor)
            os.close(copy)


def _line(found: "Verification") -> str:
    if not found.good:
        return f"{found.path}: BAD: {'; '.join(' '.join(problem.split()) for problem in found.problems)}"
    return (
        f"{found.path}: good: {found.format}, {', '.join(found.shapes)}, "
        f"{found.finite} of {found.values} finite, {found.least:.6g} to {found.largest:.6g}, "
        f"id {found.id[:16]}…, version {found.version}, "
        f"sha256 {found.sha256}{''.join(f'; note: {note}' for note in found.notes)}"
    )


def _record(found: "Verification") -> dict[str, object]:
    known = found.finite > 0
    return {
        "path": str(found.path),
        "good": found.good,
        "problems": list(found.problems),
        "notes": list(found.notes),
        "format": found.format,
        "sha256": found.sha256,
        "id": found.id,
        "version": found.version,
        "shapes": list(found.shapes),
        "values": found.values,
        "finite": found.finite,
        "least": found.least if known else None,
        "largest": found.largest if known else None,
    }
