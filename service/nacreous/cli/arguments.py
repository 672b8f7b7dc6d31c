"""Arguments and options that several commands share, each written once."""

from pathlib import Path
from typing import Annotated

import typer

from nacreous.formats.names import FormatName

__all__ = ["AsJson", "Assignments", "Formats", "OutputFolder", "SpecOrPreset"]

_FORMATS = "Format to write, exr without one; may be given again.\n\n" + "\n\n".join(
    f"{name}: {name.advice}" for name in FormatName
)

SpecOrPreset = Annotated[
    str, typer.Argument(metavar="SPEC|PRESET", help="A .toml or .json file, or a name of `nacreous presets`.")
]
Assignments = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="FIELD=VALUE", help="Change a field of the spec: table.cos_theta=256."),
]
Formats = Annotated[
    list[FormatName] | None,
    typer.Option("--format", metavar="FORMAT", help=_FORMATS),
]
OutputFolder = Annotated[
    Path, typer.Option("--output", "-o", metavar="DIR", help="Folder to write to; made if absent.")
]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object a line, and nothing else.")]
