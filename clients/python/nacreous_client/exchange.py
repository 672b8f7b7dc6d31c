"""One question and its answer, repeated where the service asks for time."""

import json
from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from email.utils import parsedate_to_datetime
from http import HTTPStatus
from typing import Any, TypeVar

from nacreous_client.answers import parsed
from nacreous_client.errors import BusyError, ServiceError, UnavailableError, UnreachableError, problem_error
from nacreous_client.retry import Patience, Retry
from nacreous_client.steps import Pause, Reply, Request, Steps

__all__ = ["REPEATED", "accepted", "asked", "exchange", "posted"]

T = TypeVar("T")

REPEATED = (UnreachableError, BusyError, UnavailableError)
"""Failures that another attempt may mend."""


def exchange(request: Request, retry: Retry) -> Steps[Reply]:
    """Send a request until it is answered; raises `ServiceError`."""
    patience = Patience(retry)
    while True:
        try:
            return accepted((yield request))
        except REPEATED as failure:
            wait_s = patience.pause_s(failure)
        yield Pause(wait_s)


def accepted(reply: Reply) -> Reply:
    """Return an answer that is no error; raises the `ProblemError` that it is otherwise."""
    if reply.status < HTTPStatus.BAD_REQUEST:
        return reply
    raise problem_error(reply.status, _problem(reply), _retry_after_s(reply))


def _problem(reply: Reply) -> Mapping[str, Any]:
    """Return the problem details, or what a proxy's answer without them comes to."""
    try:
        document = parsed(reply.body, dict)
    except ServiceError:
        words = reply.body[:200].decode("utf-8", "replace").split()
        return {"detail": " ".join([f"the service answered {reply.status}", *words])}
    return document


def _retry_after_s(reply: Reply) -> float:
    """Return the Retry-After of an answer, seconds or a date (RFC 9110, 10.2.3); 0 where there is none."""
    value = reply.headers.get("Retry-After", "").strip()
    if value.isascii() and value.isdigit():
        return float(value)
    try:
        return max(0.0, (parsedate_to_datetime(value) - datetime.now(UTC)).total_seconds())
    except (ValueError, TypeError):  # no date, or one without a zone
        return 0.0


def asked(path: str, read: Callable[[Any], T], retry: Retry) -> Steps[T]:
    """Return what `read` makes of the document at a path."""
    reply = yield from exchange(Request("GET", path), retry)
    return parsed(reply.body, read)


def posted(path: str, document: Mapping[str, Any], retry: Retry) -> Steps[Reply]:
    """Send a document, and return the answer; raises `ValueError` for what JSON has no number for."""
    body = json.dumps(document, allow_nan=False).encode()
    return (yield from exchange(Request("POST", path, {"Content-Type": "application/json"}, body), retry))
