"""``--server``: the service that computes in place of this computer; light, as every run imports it."""

import os
from dataclasses import dataclass, field
from typing import Annotated

import typer

from nacreous.errors import NacreousError, SpecError

__all__ = ["RefusedError", "Server", "ServerAddress", "choose_server", "server_of"]

ServerAddress = Annotated[
    str | None,
    typer.Option(
        "--server",
        metavar="URL",
        envvar="NACREOUS_SERVER",
        help="Have a service compute instead of this computer; NACREOUS_SERVER_KEY holds its key.",
    ),
]

_SERVED = ("tabulate", "presets", "materials")
"""The commands that ask a service."""


@dataclass(frozen=True)
class Server:
    """A service: where it is, and the key that it wants."""

    address: str
    key: str = field(default="", repr=False)


class RefusedError(NacreousError):
    """The service takes what was asked for as wrong, or as too large."""


def choose_server(context: typer.Context, address: str | None) -> None:
    """Keep the service for the command that follows; raises `SpecError` where it could do nothing with it.

    One that the environment names is for the commands that can use it, and nothing to the others.
    """
    if not address:
        return
    command = context.invoked_subcommand
    if command not in _SERVED and not _from_environment(context):
        raise SpecError("--server", f"a command that asks a service ({', '.join(_SERVED)})", f"{command}")
    context.obj = Server(address, os.environ.get("NACREOUS_SERVER_KEY", ""))


def _from_environment(context: typer.Context) -> bool:
    source = context.get_parameter_source("server")
    return source is not None and source.name == "ENVIRONMENT"


def server_of(context: typer.Context) -> Server | None:
    """Return the service that was chosen; None to compute here."""
    return context.obj if isinstance(context.obj, Server) else None
