"""The outermost layers: what a request came to is counted and logged, and every error is an answer."""

import itertools
import logging
import secrets
import time

from starlette.requests import ClientDisconnect
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from nacreous.web.logs import log_request
from nacreous.web.metrics import Metrics
from nacreous.web.problems import problem_of

__all__ = ["TEMPLATE", "HeadAsGet", "Observed", "Problems"]

TEMPLATE = "nacreous.template"
"""Key of the scope under which a layer that answers without the router leaves the template of the route."""

_ANSWER = "nacreous.answer"
"""Key of the scope under which the outermost layer leaves what has been sent of the answer."""

_METHODS = frozenset({"GET", "HEAD", "POST", "DELETE", "OPTIONS", "PUT", "PATCH", "TRACE"})
_SECURITY = [(b"x-content-type-options", b"nosniff"), (b"referrer-policy", b"no-referrer")]
_CLIENT_CLOSED = 499
"""nginx's number for a client that went away before the answer began; it is logged and never sent."""

_logger = logging.getLogger("nacreous.web")


class _Answer:
    """What has been sent of one answer, with the headers that all of them have."""

    def __init__(self, send: Send, request_id: str) -> None:
        self._send, self.request_id = send, request_id
        self.status, self.sent_bytes = _CLIENT_CLOSED, 0

    async def send(self, message: Message) -> None:
        if message["type"] == "http.response.start":
            self.status = message["status"]
            message["headers"] = [
                *message["headers"],
                *_SECURITY,
                (b"x-request-id", self.request_id.encode()),
            ]
        else:
            self.sent_bytes += len(message.get("body", b""))
        await self._send(message)


class Observed:
    """Counts and logs each request, and gives its answer an id and the headers that guard a browser."""

    def __init__(self, app: ASGIApp, metrics: Metrics) -> None:
        self._app, self._metrics = app, metrics
        self._start, self._numbers = secrets.token_hex(4), itertools.count()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass the request on."""
        began = time.perf_counter()
        request_id = f"{self._start}{next(self._numbers):08x}"
        answer = _Answer(send, request_id)
        scope[_ANSWER] = answer
        try:
            await self._app(scope, receive, answer.send)
        finally:
            seconds = time.perf_counter() - began
            method = scope["method"] if scope["method"] in _METHODS else "other"
            route = _template(scope)
            self._metrics.observe(method, route, answer.status, seconds)
            log_request(request_id, method, route, answer.status, seconds, answer.sent_bytes)


def _template(scope: Scope) -> str:
    """Return the template of the route that answered: what a client chose is part of no label."""
    template = scope.get(TEMPLATE)
    if template is None:
        template = getattr(scope.get("route"), "path", "none")
    return str(template).replace(":path", "")


class Problems:
    """Answers every error that the layers within raise with its problem."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass the request on, and answer in its place where it fails before its answer has begun."""
        try:
            await self._app(scope, receive, send)
        except ClientDisconnect:
            return  # nobody is there to be answered
        except Exception as error:
            answer: _Answer = scope[_ANSWER]
            if answer.status != _CLIENT_CLOSED:
                raise
            problem = problem_of(error)
            if problem.kind == "internal":
                facts = {"id": answer.request_id}
                _logger.exception("unforeseen error", extra={"facts": facts})
            await problem.response()(scope, receive, send)


class HeadAsGet:
    """Answers HEAD as GET without the body, on every route; a range has no meaning there."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass the request on."""
        if scope["method"] != "HEAD":
            await self._app(scope, receive, send)
            return
        headers = [(name, value) for name, value in scope["headers"] if name != b"range"]
        as_get = {**scope, "method": "GET", "headers": headers, "nacreous.head": True}
        try:
            await self._app(as_get, receive, _without_body(send))
        finally:
            for key in (TEMPLATE, "route"):
                if key in as_get:
                    scope[key] = as_get[key]


def _without_body(send: Send) -> Send:
    async def send_without_body(message: Message) -> None:
        if message["type"] == "http.response.body":
            message = {**message, "body": b""}
        await send(message)

    return send_without_body
