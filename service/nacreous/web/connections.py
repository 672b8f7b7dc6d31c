"""One connection of a client, bounded where uvicorn leaves it unbounded.

uvicorn has no limit on the size of a header, nor on the time it takes to come, and keeps a connection on
which a body still trickles after the answer. A client that does any of these on purpose is cut off here,
before a request exists; what is wrong with a whole request is said by `nacreous.web.limits`.
"""

import asyncio
from http import HTTPStatus
from typing import Any

from uvicorn.config import Config
from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol
from uvicorn.server import ServerState

from nacreous.web.problems import Problem

__all__ = ["Connection", "connection_type"]


class Connection(HttpToolsProtocol):
    """A connection that is closed where its client takes too long over a header, or sends one too large."""

    header_seconds: float
    max_header: int
    most_connections: int

    def __init__(
        self,
        config: Config,
        server_state: ServerState,
        app_state: dict[str, Any],
        _loop: asyncio.AbstractEventLoop | None = None,
    ) -> None:
        super().__init__(config, server_state, app_state, _loop)
        self._waiting: asyncio.TimerHandle | None = None
        self._header_bytes = 0
        self._in_header, self._part_ended = True, False

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Begin to wait for a header, or close what comes on top of too many."""
        super().connection_made(transport)
        if len(self.connections) > self.most_connections:
            detail = f"{self.most_connections} connections are open already"
            self._refuse(HTTPStatus.SERVICE_UNAVAILABLE, "connections", detail)
            return
        self._await_header()

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait for nothing any more."""
        self._header_came()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Count what comes of a header that is not complete."""
        if self.transport.is_closing():
            return
        if self._in_header and self._waiting is None:
            self._await_header()  # of the next request on the same connection
        self._part_ended = False
        super().data_received(data)
        if self._part_ended or not self._in_header:
            return  # how much of it is of a header nobody says; the next will be counted
        self._header_bytes += len(data)
        if self._header_bytes > self.max_header:
            detail = f"expected a header of at most {self.max_header:,} bytes"
            self._refuse(HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE, "header", detail)

    def on_headers_complete(self) -> None:
        """Stop the clock; the request begins."""
        self._in_header, self._part_ended = False, True
        self._header_came()
        super().on_headers_complete()

    def on_message_complete(self) -> None:
        """Expect the header of the next request."""
        self._in_header, self._part_ended, self._header_bytes = True, True, 0
        super().on_message_complete()

    def on_response_complete(self) -> None:
        """Close where the body of the request still comes: nobody reads it any more."""
        super().on_response_complete()
        if self.cycle.more_body and not self.transport.is_closing():
            self.transport.close()

    def send_400_response(self, msg: str) -> None:
        """Answer what is no HTTP; uvicorn's message is the detail."""
        self._refuse(HTTPStatus.BAD_REQUEST, "http", msg)

    def _await_header(self) -> None:
        self._waiting = self.loop.call_later(self.header_seconds, self._too_slow)

    def _header_came(self) -> None:
        if self._waiting is not None:
            self._waiting.cancel()
            self._waiting = None

    def _too_slow(self) -> None:
        detail = f"expected a whole header within {self.header_seconds:g} s"
        self._refuse(HTTPStatus.REQUEST_TIMEOUT, "slow-header", detail)

    def _refuse(self, status: HTTPStatus, kind: str, detail: str) -> None:
        """Answer in place of the application, and close."""
        self._header_came()
        if self.transport.is_closing():
            return
        body = Problem(status, kind, detail).body()
        head = (
            f"HTTP/1.1 {status.value} {status.phrase}\r\ncontent-type: application/problem+json\r\n"
            f"content-length: {len(body)}\r\nx-content-type-options: nosniff\r\nconnection: close\r\n\r\n"
        )
        self.transport.write(head.encode() + body)
        self.transport.close()


def connection_type(header_seconds: float, max_header: int, most_connections: int) -> type[Connection]:
    """Return the type of connections with these bounds, which uvicorn makes objects of."""
    bounds = {
        "header_seconds": header_seconds,
        "max_header": max_header,
        "most_connections": most_connections,
    }
    return type("BoundedConnection", (Connection,), bounds)
