"""How the program ends: the one place that turns an error into an exit code and a message.

0 done, 1 failed, 2 a wrong spec or option or a table larger than the byte budget, 130 interrupted.
"""

import sys
from collections.abc import Mapping
from types import MappingProxyType

from typer.exceptions import TyperException

from nacreous.cli.server import RefusedError
from nacreous.errors import BudgetError, NacreousError, SpecError, reason

__all__ = ["FAILED", "INTERRUPTED", "NO_PLATFORM", "WRONG_INPUT", "exit_code", "report"]

FAILED = 1
WRONG_INPUT = 2
NO_PLATFORM = 78
"""Configuration error, EX_CONFIG of sysexits.h: `nacreous doctor` found no OpenCL."""
INTERRUPTED = 130
"""128 + SIGINT, as a shell reports it."""

_PYDANTIC = "Value error, "
"""What pydantic puts before a message that typer then shows."""

_CODES: Mapping[type[BaseException], int] = MappingProxyType(
    {
        KeyboardInterrupt: INTERRUPTED,
        SpecError: WRONG_INPUT,
        BudgetError: WRONG_INPUT,
        RefusedError: WRONG_INPUT,
        NacreousError: FAILED,
        OSError: FAILED,
    }
)
"""The first class that an error belongs to decides."""


def exit_code(error: BaseException) -> int:
    """Return the exit code of an error; one that nobody foresaw is raised again, with its traceback."""
    if isinstance(error, TyperException):
        return error.exit_code
    for kind, code in _CODES.items():
        if isinstance(error, kind):
            return code
    raise error


def report(error: BaseException) -> None:
    """Write the one message of an error to stderr."""
    print(f"nacreous: {_message(error)}", file=sys.stderr)


def _message(error: BaseException) -> str:
    if isinstance(error, KeyboardInterrupt):
        return "interrupted"
    if isinstance(error, TyperException):
        return " ".join(error.format_message().split()).replace(_PYDANTIC, "", 1)
    if isinstance(error, OSError):
        return f"{error.filename}: {reason(error)}" if error.filename else reason(error)
    return str(error)
