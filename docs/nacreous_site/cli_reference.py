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
    return section(
        identifier("cli", path.removeprefix(_PROGRAM)),
        [literal(path)],
        *paragraphs(command.help or ""),
        code_block(_usage(path, command), "text"),
        *(_parameter_entry(path, parameter) for parameter in command.params),
        *paragraphs(command.epilog or ""),
    )


def _usage(path: str, command: Command) -> str:
    arguments = [_argument_usage(each) for each in command.params if _is_argument(each)]
    ending = ["COMMAND ..."] if isinstance(command, typer.core.TyperGroup) else arguments
    return " ".join([path, *(["[OPTIONS]"] if len(arguments) < len(command.params) else []), *ending])


def _argument_usage(argument: Parameter) -> str:
    shown = f"{_metavar(argument)}..." if argument.nargs == -1 else _metavar(argument)
    return shown if argument.required else f"[{shown}]"


def _parameter_entry(path: str, parameter: Parameter) -> nodes.Element:
    return entry(
        identifier("cli", path.removeprefix(_PROGRAM), parameter.name or ""),
        _spelling(parameter),
        *paragraphs(parameter.help or ""),
        *facts(_facts(parameter)),
        note="required" if parameter.required else "",
    )


def _spelling(parameter: Parameter) -> str:
    if _is_argument(parameter):
        return _metavar(parameter)
    names = ", ".join([*parameter.opts, *parameter.secondary_opts])
    return names if parameter.is_flag else f"{names} {_metavar(parameter)}"


def _is_argument(parameter: Parameter) -> bool:
    return isinstance(parameter, typer.core.TyperArgument)


def _metavar(parameter: Parameter) -> str:
    by_type = parameter.name if _is_argument(parameter) else parameter.display_type
    return parameter.metavar or str(by_type).upper()


def _facts(parameter: Parameter) -> dict[str, Inline]:
    default = parameter.default
    shown = default not in (None, False, "", (), []) and not callable(default)
    several = getattr(parameter, "multiple", False)
    return {
        "Default": [literal(str(default))] if shown else [],
        "Variable": [literal(str(parameter.envvar))] if parameter.envvar else [],
        "Given": [nodes.Text("as often as wanted")] if several else [],
    }
