"""Every error as RFC 9457 problem+json: the one table from what went wrong to a status.

Whatever a request held, an answer echoes at most 60 characters of it (`nacreous.optics.value.shown`) and is
no longer than 4 KB.
"""

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from http import HTTPStatus
from types import MappingProxyType

from starlette.responses import Response

from nacreous.errors import (
    BudgetError,
    BusyError,
    DeadlineError,
    DeviceError,
    FileFormatError,
    MissingError,
    NacreousError,
    NumericalError,
    SpecError,
    StoreError,
    UnavailableError,
)
from nacreous.web.problem_kinds import PREFIX

__all__ = ["MAX_BYTES", "MEDIA_TYPE", "Problem", "ProblemError", "problem_of"]

MEDIA_TYPE = "application/problem+json"
MAX_BYTES = 4096
_MOST_CHARACTERS = 400
"""Of one text of a problem. There are five: in ASCII all fit, and where JSON escapes most of their characters
with six each, `Problem.body` shortens them further."""


@dataclass(frozen=True)
class Problem:
    """What is wrong with a request, or with the service.

    Parameters
    ----------
    status : HTTPStatus
    kind : str
        Its type is ``urn:nacreous:problem:`` and this.
    detail : str
        One message for a person.
    facts : mapping of str to str
        ``field``, ``expected``, ``got`` and ``remedy``, where they are known.
    headers : mapping of str to str
        Headers of the answer, such as Retry-After.
    """

    status: HTTPStatus
    kind: str
    detail: str
    facts: Mapping[str, str] = field(default_factory=dict)
    headers: Mapping[str, str] = field(default_factory=dict)

    def body(self) -> bytes:
        """Return the JSON document, of at most 4 KB."""
        for most in (_MOST_CHARACTERS, _MOST_CHARACTERS // 4):
            document = json.dumps(self._document(most), separators=(",", ":")).encode()
            if len(document) <= MAX_BYTES:
                break
        return document

    def _document(self, most: int) -> dict[str, object]:
        texts = {"detail": self.detail, **self.facts}
        return {
            "type": f"{PREFIX}{self.kind}",
            "title": self.status.phrase,
            "status": self.status.value,
            **{name: _shortened(text, most) for name, text in texts.items() if text},
        }

    def response(self) -> Response:
        """Return the answer."""
        return Response(self.body(), self.status, dict(self.headers), MEDIA_TYPE)


def _shortened(text: str, most: int) -> str:
    return text if len(text) <= most else f"{text[: most - 1]}…"


class ProblemError(Exception):
    """A problem of HTTP itself, which no part of the domain knows."""

    def __init__(
        self,
        status: HTTPStatus,
        kind: str,
        detail: str,
        *,
        facts: Mapping[str, str] = MappingProxyType({}),
        headers: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        self.problem = Problem(status, kind, detail, facts, headers)
        super().__init__(detail)


@dataclass(frozen=True)
class _Kind:
    status: HTTPStatus
    name: str


_KINDS: Mapping[type[NacreousError], _Kind] = MappingProxyType(
    {
        SpecError: _Kind(HTTPStatus.UNPROCESSABLE_ENTITY, "spec"),
        BudgetError: _Kind(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, "budget"),
        MissingError: _Kind(HTTPStatus.NOT_FOUND, "missing"),
        FileFormatError: _Kind(HTTPStatus.UNPROCESSABLE_ENTITY, "format"),
        BusyError: _Kind(HTTPStatus.TOO_MANY_REQUESTS, "busy"),
        UnavailableError: _Kind(HTTPStatus.SERVICE_UNAVAILABLE, "unavailable"),
        DeadlineError: _Kind(HTTPStatus.GATEWAY_TIMEOUT, "deadline"),
        StoreError: _Kind(HTTPStatus.SERVICE_UNAVAILABLE, "store"),
        DeviceError: _Kind(HTTPStatus.SERVICE_UNAVAILABLE, "device"),
        NumericalError: _Kind(HTTPStatus.INTERNAL_SERVER_ERROR, "numerical"),
    }
)
"""The first class that an error belongs to decides."""

_UNFORESEEN = _Kind(HTTPStatus.INTERNAL_SERVER_ERROR, "internal")
_RETRY_AFTER_S = 3
"""Where what failed does not say when to ask again."""


def problem_of(error: Exception) -> Problem:
    """Return the problem of any error; one that nobody foresaw says nothing of its inside."""
    if isinstance(error, ProblemError):
        return error.problem
    kind = next((kind for known, kind in _KINDS.items() if isinstance(error, known)), _UNFORESEEN)
    if kind is _UNFORESEEN:
        return Problem(kind.status, kind.name, "the service has failed at this request; its log says why")
    facts = {}
    if isinstance(error, SpecError):
        facts = {name: getattr(error, name) for name in ("field", "expected", "got", "remedy")}
    return Problem(kind.status, kind.name, str(error), facts, _retry(error, kind.status))


def _retry(error: Exception, status: HTTPStatus) -> dict[str, str]:
    """Say when to ask again, in whole seconds, wherever that can help."""
    if status not in {HTTPStatus.TOO_MANY_REQUESTS, HTTPStatus.SERVICE_UNAVAILABLE}:
        return {}
    seconds = getattr(error, "retry_after_s", _RETRY_AFTER_S)
    return {"Retry-After": str(max(1, math.ceil(seconds)))}
