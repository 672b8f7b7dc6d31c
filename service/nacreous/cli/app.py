"""The program `nacreous`."""

import sys
from typing import Annotated

import typer
from typer.exceptions import TyperException

from nacreous.cli.devices import devices
from nacreous.cli.doctor import doctor
from nacreous.cli.exit_codes import INTERRUPTED, exit_code, report
from nacreous.cli.materials import materials
from nacreous.cli.presets import presets
from nacreous.cli.preview import preview
from nacreous.cli.schema import schema
from nacreous.cli.serve import serve
from nacreous.cli.server import ServerAddress, choose_server
from nacreous.cli.tabulate import tabulate
from nacreous.cli.verify import verify
from nacreous.errors import NacreousError

__all__ = ["main", "make_app"]

_COMMANDS = (tabulate, preview, presets, schema, devices, doctor, verify, serve)


def main() -> None:
    """Run the program; every error that is foreseen ends here, as one message and an exit code."""
    try:
        code = make_app()(sys.argv[1:] or ["--help"], prog_name="nacreous", standalone_mode=False)
    except (TyperException, NacreousError, OSError, KeyboardInterrupt) as error:
        report(error)
        code = exit_code(error)
    else:
        if code == INTERRUPTED:  # typer has caught it, and says nothing
            report(KeyboardInterrupt())
    sys.exit(code)


def make_app() -> typer.Typer:
    """Return the program with its commands."""
    app = typer.Typer(
        name="nacreous",
        help="Tabulated BSDFs of thin-film interference, for renderers without spectral interference.",
        epilog="Begin with: nacreous tabulate soap-bubble",
        add_completion=False,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,  # plain help: importing what frames it takes as long as all the rest
    )
    app.callback()(_options)
    for command in _COMMANDS:
        app.command()(command)
    app.add_typer(materials(), name="materials")
    return app


def _show_version(asked: bool) -> None:  # noqa: FBT001 - typer calls it with the flag's value
    if asked:
        import nacreous

        print(f"nacreous {nacreous.__version__}")
        raise typer.Exit


def _options(
    context: typer.Context,
    *,
    server: ServerAddress = None,
    version: Annotated[  # noqa: ARG001 - its callback has used it
        bool,
        typer.Option("--version", callback=_show_version, is_eager=True, help="Print the version and stop."),
    ] = False,
) -> None:
    """Hold the options that belong to no command."""
    choose_server(context, server)
