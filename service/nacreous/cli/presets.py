"""``nacreous presets``: the specs that come with Nacreous."""

from typing import Annotated

import typer

from nacreous.cli.arguments import AsJson
from nacreous.cli.server import server_of

__all__ = ["presets"]


def presets(
    context: typer.Context,
    name: Annotated[str | None, typer.Argument(help="Print this preset's spec, as TOML.")] = None,
    *,
    as_json: AsJson = False,
) -> None:
    """List the presets, or print one.

    A preset that is printed is a spec to begin your own with; a service has it as JSON.
    """
    from nacreous.cli.listing import print_columns, print_json_lines
    from nacreous.tables.presets import preset, preset_names, preset_text

    if server := server_of(context):
        from nacreous.cli.remote_listings import print_preset, print_presets

        if name is None:
            print_presets(server, print_json_lines if as_json else print_columns)
        else:
            print_preset(server, name)
        return
    if name is not None:
        print(preset(name).model_dump_json() if as_json else preset_text(name))
        return
    rows = [{"name": known, "description": preset(known).description} for known in preset_names()]
    (print_json_lines if as_json else print_columns)(rows)
