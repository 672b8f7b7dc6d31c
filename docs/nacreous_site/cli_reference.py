"""The reference of the program: each command as the program itself describes it, in the program's order."""

from collections.abc import Iterable, Iterator

import typer
from docutils import nodes

from nacreous.cli.app import make_app
from nacreous_site.entries import (
    Inline,
    ReferenceDirective,
    code_block,
    entry,
    facts,
    identifier,
    literal,
    paragraphs,
    section,
)

__all__ = ["CliReference", "commands"]

_PROGRAM = "nacreous"

Command = typer.core.TyperCommand | typer.core.TyperGroup
Parameter = typer.core.TyperOption | typer.core.TyperArgument


class CliReference(ReferenceDirective):
    """``{cli-reference}``: the program's commands."""

    def parts(self) -> Iterable[nodes.Element]:
        """Return a section for each command, the program's own options first."""
        return [_command_section(path, command) for path, command in commands()]


def commands() -> Iterator[tuple[str, Command]]:
    """Yield each command by the words that call it, such as ``nacreous materials search``."""
    yield from _below(_PROGRAM, typer.main.get_command(make_app()))


def _below(path: str, command: Command) -> Iterator[tuple[str, Command]]:
    yield path, command
    for name, inner in getattr(command, "commands", {}).items():
        yield from _below(f"{path} {name}", inner)


def _command_section(path: str, command: Command) -> nodes.section:
    with command.make_context(path, [], resilient_parsing=True) as context:
        return section(
            identifier("cli", path.removeprefix(_PROGRAM)),
            [literal(path)],
            *paragraphs(command.help or ""),
            code_block(command.get_usage(context).removeprefix("Usage: "), "text"),
            *(_parameter_entry(path, parameter, context) for parameter in command.params),
            *paragraphs(command.epilog or ""),
        )


def _parameter_entry(path: str, parameter: Parameter, context: typer.Context) -> nodes.Element:
    spelling, _ = parameter.get_help_record(context)
    return entry(
        identifier("cli", path.removeprefix(_PROGRAM), parameter.name or ""),
        spelling,
        *paragraphs(parameter.help or ""),
        *facts(_facts(parameter)),
        note="required" if parameter.required else "",
    )


def _facts(parameter: Parameter) -> dict[str, Inline]:
    default = parameter.default
    shown = default not in (None, False, "", (), []) and not callable(default)
    return {
        "Default": [literal(str(default))] if shown else [],
        "Variable": [literal(str(parameter.envvar))] if parameter.envvar else [],
        "Given": [nodes.Text("as often as wanted")] if parameter.multiple else [],
    }
