"""Calls of a service from the command line: its failures are those of this program, in the same words."""

from collections.abc import Iterator
from contextlib import contextmanager

from nacreous_client import (
    AddressError,
    BudgetError,
    Client,
    DeadlineError,
    KeyRefusedError,
    ServiceError,
    SpecError,
    UnreachableError,
)

from nacreous import errors
from nacreous.cli.server import RefusedError, Server
from nacreous.optics.value import shown

__all__ = ["calling"]


@contextmanager
def calling(server: Server) -> Iterator[Client]:
    """Yield a client of the service; what it raises leaves as a `NacreousError` with one message."""
    try:
        with Client(server.address, server.key) as client:
            yield client
    except ServiceError as error:
        raise _translated(error, server) from None


def _translated(error: ServiceError, server: Server) -> errors.NacreousError:
    match error:
        case AddressError() if "address" in str(error):
            return errors.SpecError(
                "--server",
                "an address such as http://localhost:8000",
                shown(errors.without_user_info(server.address)),
            )
        case AddressError():
            return errors.SpecError("NACREOUS_SERVER_KEY", "a key of visible ASCII characters", "others")
        case SpecError(expected="", kind="format"):
            return errors.FileFormatError(str(error))
        case SpecError() if error.expected:
            return errors.SpecError(error.field, error.expected, error.got, error.remedy)
        case SpecError() | BudgetError():
            return RefusedError(str(error))
        case DeadlineError():
            return errors.DeadlineError(str(error))
        case KeyRefusedError():
            return errors.NacreousError(f"{error}; NACREOUS_SERVER_KEY holds the key that is sent")
        case UnreachableError():
            remedy = "`nacreous serve` starts a service; --server or NACREOUS_SERVER says where it is"
            return errors.NacreousError(f"{error}; {remedy}")
    return errors.NacreousError(str(error))
