"""What can go wrong between here and a service.

The service says what is wrong as problem details (RFC 9457); each status has a class here, and a spec that is
wrong arrives in the words in which the service found it so: field, expected, got, remedy.
"""

import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

__all__ = [
    "AddressError",
    "AnswerError",
    "BudgetError",
    "BusyError",
    "ChecksumError",
    "DeadlineError",
    "JobFailedError",
    "KeyRefusedError",
    "MissingError",
    "ProblemError",
    "ServiceError",
    "SpecError",
    "UnavailableError",
    "UnreachableError",
    "problem_error",
    "without_user_info",
]

_USER_INFO = re.compile(r"(?<=://)(?:[^/:@]*:(?!\d+(?:/|$)).*|[^/?#]*)@")
"""Of an address, up to its last @, for a password may hold a slash; what a port follows is none."""


class ServiceError(Exception):
    """Any failure of a call; its text is one message for a person.

    Attributes
    ----------
    retry_after_s : float
        How long the service asks to be left alone; 0 where it does not say.
    """

    retry_after_s: float = 0.0


class AddressError(ServiceError):
    """The address of the service, or its key, is none."""


class UnreachableError(ServiceError):
    """Nothing answers at the address, or what answers has broken off.

    Parameters
    ----------
    address : str
        Where the service should be.
    message : str
    """

    def __init__(self, address: str, message: str) -> None:
        self.address = address
        super().__init__(message)


class AnswerError(ServiceError):
    """The answer is none of a Nacreous service's."""


class ChecksumError(ServiceError):
    """The bytes that came are not those that the service has sent; nothing is kept of them."""


class JobFailedError(ServiceError):
    """A job ended without its tables: it has failed, or was cancelled."""


class ProblemError(ServiceError):
    """The service has answered that it cannot or will not.

    Parameters
    ----------
    status : int
        Of HTTP.
    document : mapping
        The problem details; members that are missing, or no text, are empty.
    retry_after_s : float

    Attributes
    ----------
    kind : str
        Last part of the problem's type, such as ``"spec"``.
    title, detail : str
    field, expected, got, remedy : str
        Of a spec or a parameter that is wrong: its dotted path, what would have been right, what came, and
        what to do about it.
    """

    def __init__(self, status: int, document: Mapping[str, Any], retry_after_s: float = 0.0) -> None:
        self.status, self.retry_after_s = status, retry_after_s
        self.kind = _text(document, "type").rpartition(":")[2]
        self.title, self.detail = _text(document, "title"), _text(document, "detail")
        self.field, self.expected = _text(document, "field"), _text(document, "expected")
        self.got, self.remedy = _text(document, "got"), _text(document, "remedy")
        super().__init__(self.detail or self.title or f"the service answered {status}")


def _text(document: Mapping[str, Any], member: str) -> str:
    value = document.get(member)
    return value if isinstance(value, str) else ""


class SpecError(ProblemError):
    """The spec, the sweep or the file asked for is wrong (400, 415, 422)."""


class BudgetError(ProblemError):
    """The table or the document is larger than the service takes (413)."""


class KeyRefusedError(ProblemError):
    """The service wants a key, or another one (401, 403)."""


class MissingError(ProblemError):
    """There is no such table, preset, material or job, or the table has no such file (404)."""


class BusyError(ProblemError):
    """Too much is waiting already (429); the call was repeated, and is given up."""


class UnavailableError(ProblemError):
    """The service cannot compute or store just now (503); the call was repeated, and is given up."""


class DeadlineError(ProblemError):
    """The table takes longer than the service allows (504)."""


_OF_STATUS: Mapping[int, type[ProblemError]] = MappingProxyType(
    {
        400: SpecError,
        401: KeyRefusedError,
        403: KeyRefusedError,
        404: MissingError,
        413: BudgetError,
        415: SpecError,
        422: SpecError,
        429: BusyError,
        503: UnavailableError,
        504: DeadlineError,
    }
)


def problem_error(status: int, document: Mapping[str, Any], retry_after_s: float = 0.0) -> ProblemError:
    """Return the error of a status; `ProblemError` itself for one without a class of its own."""
    return _OF_STATUS.get(status, ProblemError)(status, document, retry_after_s)


def without_user_info(address: str) -> str:
    """Return an address as a message shows it: without the name and the password before its host."""
    return _USER_INFO.sub("…@", address)
