"""Bounds on what one service does at a time, and on what a request's header may hold."""

from collections.abc import Mapping
from http import HTTPStatus
from types import MappingProxyType

from starlette.types import ASGIApp, Receive, Scope, Send

from nacreous.web.keys import OPEN_PATHS
from nacreous.web.problems import ProblemError
from nacreous.web.service import Service

__all__ = ["Limits"]


class Limits:
    """Refuses a request that comes on top of too many, or whose header is too large; probes pass."""

    def __init__(self, app: ASGIApp, service: Service) -> None:
        self._app, self._service = app, service

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass the request on, or raise `ProblemError` 431 or 503."""
        if scope["path"] in OPEN_PATHS:
            await self._app(scope, receive, send)
            return
        self._check(scope)
        self._service.request_begins()
        try:
            await self._app(scope, receive, send)
        finally:
            self._service.request_ends()

    def _check(self, scope: Scope) -> None:
        settings = self._service.settings
        if self._service.stopping.is_set():
            raise _unavailable("stopping", "the service is stopping", {"Connection": "close"})
        if self._service.running >= settings.concurrency:
            raise _unavailable("concurrency", f"{settings.concurrency} requests are being answered already")
        size = len(scope.get("raw_path") or b"") + len(scope["query_string"])
        size += sum(len(name) + len(value) + 4 for name, value in scope["headers"])
        if size > settings.max_header:
            detail = f"expected a header of at most {settings.max_header:,} bytes, got {size:,}"
            raise ProblemError(
                HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE, "header", detail, headers={"Connection": "close"}
            )


def _unavailable(kind: str, detail: str, headers: Mapping[str, str] = MappingProxyType({})) -> ProblemError:
    return ProblemError(HTTPStatus.SERVICE_UNAVAILABLE, kind, detail, headers={"Retry-After": "1", **headers})
