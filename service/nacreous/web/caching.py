"""Files that never change, over HTTP: strong ETags, 304, ranges and compression (RFC 9110, RFC 9111).

A file's ETag is its SHA-256, in hex and in quotes; that of its gzip form has ``-gzip`` behind it. One range
is answered with 206; several in one header, which nobody needs and which can be made to cost much, are
answered with the whole file, as RFC 9110, section 14.2, allows.
"""

import gzip
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from http import HTTPStatus

from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from nacreous.web.problems import ProblemError

__all__ = [
    "IMMUTABLE",
    "REVALIDATE",
    "FileResponse",
    "RawHeaders",
    "Representation",
    "compressed",
    "header_of",
    "takes_gzip",
]

RawHeaders = list[tuple[bytes, bytes]]

IMMUTABLE = b"max-age=31536000, immutable"
"""Cache-Control of what has its content's hash in its name."""
REVALIDATE = b"max-age=0, must-revalidate"
"""Cache-Control of what a new version of Nacreous may change."""

_RANGE = re.compile(rb"bytes[ \t]*=[ \t]*(\d{0,19})-(\d{0,19})[ \t]*", re.IGNORECASE)
_MANY_TAGS = 4096
"""Bytes of If-None-Match that are looked at."""
_COMPRESSION_LEVEL = 5


@dataclass(frozen=True)
class Representation:
    """Bytes that can be answered.

    Parameters
    ----------
    payload : bytes
    tag : str
        What their ETag has between its quotes.
    media_type : str
    cache_control : bytes
    name : str, optional
        File name that a browser saves them under.
    encoding : str, optional
        Content encoding, such as ``"gzip"``.
    varies : bytes, optional
        Headers of requests that the form depends on.
    """

    payload: bytes
    tag: str
    media_type: str
    cache_control: bytes
    name: str = ""
    encoding: str = ""
    varies: bytes = b""

    def headers(self) -> RawHeaders:
        """Return what every answer with these bytes says, 304 and 206 included."""
        headers = [(b"etag", b'"%s"' % self.tag.encode()), (b"cache-control", self.cache_control)]
        if self.varies:
            headers.append((b"vary", self.varies))
        return headers

    def content_headers(self) -> RawHeaders:
        """Return what an answer that has a body says of it."""
        headers = [(b"content-type", self.media_type.encode()), (b"accept-ranges", b"bytes")]
        if self.encoding:
            headers.append((b"content-encoding", self.encoding.encode()))
        if self.name:
            headers.append((b"content-disposition", b'attachment; filename="%s"' % self.name.encode()))
        return headers


def header_of(scope: Scope, name: bytes) -> bytes:
    """Return a header of a request, several of the same name as one; empty where there is none."""
    return b",".join(value for key, value in scope["headers"] if key == name)


def compressed(representation: Representation, scope: Scope) -> Representation:
    """Return the gzip form of a representation where the client takes it and asks for no range."""
    varies = replace(representation, varies=b"Accept-Encoding")
    if not takes_gzip(scope) or header_of(scope, b"range"):
        return varies
    tag = f"{representation.tag}-gzip"
    if _has_tag(header_of(scope, b"if-none-match"), tag):
        return replace(varies, payload=b"", tag=tag)  # nothing of it will be sent
    payload = gzip.compress(representation.payload, _COMPRESSION_LEVEL, mtime=0)
    return replace(varies, payload=payload, tag=tag, encoding="gzip")


def takes_gzip(scope: Scope) -> bool:
    """Tell whether a request's Accept-Encoding has gzip."""
    for entry in header_of(scope, b"accept-encoding").lower().split(b",")[:32]:
        coding, _, weight = entry.partition(b";")
        if coding.strip() in {b"gzip", b"x-gzip"}:
            return re.fullmatch(rb"\s*q=0(\.0*)?\s*", weight) is None
    return False


class FileResponse(Response):
    """Answers a request with a representation, or a part of it, or says that it has not changed."""

    def __init__(self, representation: Representation) -> None:
        self.representation = representation
        self.background = None  # what a framework looks for; the rest of a response depends on the request

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:  # noqa: ARG002 - ASGI
        """Send the answer."""
        status, headers, body = self._answer(scope)
        await send({"type": "http.response.start", "status": status.value, "headers": headers})
        await send({"type": "http.response.body", "body": body})

    def _answer(self, scope: Scope) -> tuple[HTTPStatus, RawHeaders, bytes | memoryview]:
        file = self.representation
        headers = file.headers()
        known, asked_range, only_if = _conditions(scope["headers"])
        if known and _has_tag(known, file.tag):
            return HTTPStatus.NOT_MODIFIED, headers, b""
        headers += file.content_headers()
        size = len(file.payload)
        span = _span(asked_range, size) if asked_range and _fresh(only_if, file.tag) else None
        if span is None:
            headers.append((b"content-length", b"%d" % size))
            return HTTPStatus.OK, headers, file.payload
        first, end = span
        headers.append((b"content-range", b"bytes %d-%d/%d" % (first, end - 1, size)))
        headers.append((b"content-length", b"%d" % (end - first)))
        return HTTPStatus.PARTIAL_CONTENT, headers, memoryview(file.payload)[first:end]


def _conditions(headers: Iterable[tuple[bytes, bytes]]) -> tuple[bytes, bytes, bytes]:
    """Return If-None-Match, Range and If-Range in one pass."""
    known = asked_range = only_if = b""
    for name, value in headers:
        if name == b"if-none-match":
            known = known + b"," + value if known else value
        elif name == b"range":
            asked_range = value
        elif name == b"if-range":
            only_if = value
    return known, asked_range, only_if


def _has_tag(known: bytes, tag: str) -> bool:
    """Tell whether If-None-Match names the tag, by weak comparison (RFC 9110, section 13.1.2)."""
    if known.strip() == b"*":
        return True
    tags: Sequence[bytes] = known[:_MANY_TAGS].split(b",")
    wanted = b'"%s"' % tag.encode()
    return any(entry.strip().removeprefix(b"W/") == wanted for entry in tags)


def _fresh(only_if: bytes, tag: str) -> bool:
    """Tell whether If-Range lets a range be sent: by the strong tag, or where it is absent."""
    return not only_if or only_if.strip() == b'"%s"' % tag.encode()


def _span(asked_range: bytes, size: int) -> tuple[int, int] | None:
    """Return first byte and end of the one range that is asked for; None where the whole file is the answer.

    Raises
    ------
    ProblemError
        416: the range has no byte of the file.
    """
    match = _RANGE.fullmatch(asked_range)
    if match is None or match.groups() == (b"", b""):
        return None
    first, last = match.groups()
    if not first:
        first_byte, end = max(0, size - int(last)), size
    else:
        first_byte, end = int(first), min(size, int(last) + 1) if last else size
        if last and int(last) < int(first):
            return None
    if first_byte >= end:
        detail = f"expected a range within the {size:,} bytes of the file"
        headers = {"Content-Range": f"bytes */{size}"}
        raise ProblemError(HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE, "range", detail, headers=headers)
    return first_byte, end
