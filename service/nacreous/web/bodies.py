"""Reading a request's body: all of it, soon, and never more than is allowed.

The documents are read by `nacreous.tables.spec_document`, which refuses what a framework would choke on.
"""

import asyncio
from collections.abc import AsyncIterator, Mapping
from http import HTTPStatus
from types import MappingProxyType

from starlette.requests import ClientDisconnect, Request

from nacreous.errors import SpecError
from nacreous.optics.value import shown
from nacreous.tables.spec_document import Document, Syntax, parse
from nacreous.web.problems import ProblemError
from nacreous.web.settings import Settings

__all__ = ["MEDIA_TYPES", "read_document"]

MEDIA_TYPES: Mapping[str, Syntax] = MappingProxyType(
    {"application/json": Syntax.JSON, "application/toml": Syntax.TOML}
)
"""What a body may be."""

_LARGE_BYTES = 32 * 2**10
"""A body above it is parsed in a thread, so that others are answered meanwhile."""
_DISCARDED_BYTES = 8 * 2**20
"""What is read of a body that is too large: a client that is cut off while it sends sees no answer."""
_DISCARDING_SECONDS = 2.0
_CLOSE = MappingProxyType({"Connection": "close"})


async def read_document(request: Request, settings: Settings) -> Document:
    """Return the document of a body.

    Raises
    ------
    SpecError
        What the document holds cannot be used.
    ProblemError
        400 where it is no document at all, 408 too slow, 413 too large, 415 of another type or encoding.
    """
    syntax = _syntax(request)
    body = await _read(request, settings)
    if len(body) > _LARGE_BYTES:
        return await asyncio.to_thread(_parse, body, syntax)
    return _parse(body, syntax)


def _parse(body: bytes, syntax: Syntax) -> Document:
    try:
        return parse(body, syntax)
    except SpecError as error:
        raise ProblemError(HTTPStatus.BAD_REQUEST, "document", str(error), facts=_facts(error)) from None


def _facts(error: SpecError) -> Mapping[str, str]:
    return {"expected": error.expected, "got": error.got, "remedy": error.remedy}


def _syntax(request: Request) -> Syntax:
    """Return how the body is written; raises `ProblemError` where its headers say something else."""
    encoding = request.headers.get("content-encoding", "identity").strip().lower()
    if encoding not in {"", "identity"}:
        raise _unsupported("a body without content encoding", encoding)
    essence, _, parameters = request.headers.get("content-type", "").partition(";")
    syntax = MEDIA_TYPES.get(essence.strip().lower())
    if syntax is None:
        raise _unsupported(" or ".join(MEDIA_TYPES), essence.strip() or None)
    charset = parameters.lower().replace('"', "").replace(" ", "").partition("charset=")[2].partition(";")[0]
    if charset not in {"", "utf-8", "utf8", "us-ascii"}:
        raise _unsupported("a body in UTF-8", charset)
    return syntax


def _unsupported(expected: str, got: str | None) -> ProblemError:
    return ProblemError(
        HTTPStatus.UNSUPPORTED_MEDIA_TYPE,
        "media-type",
        f"expected {expected}, got {shown(got)}",
        headers={"Accept-Post": ", ".join(MEDIA_TYPES)},
    )


async def _read(request: Request, settings: Settings) -> bytes:
    declared = request.headers.get("content-length", "0")
    if declared.isdecimal() and int(declared[:20]) > settings.max_body:
        await _discard(request)
        raise _too_large(settings)
    body = bytearray()
    try:
        async with asyncio.timeout(settings.body_seconds):
            async for chunk in request.stream():
                body += chunk
                if len(body) > settings.max_body:
                    break
    except TimeoutError:
        detail = f"expected the whole body within {settings.body_seconds:g} s, got {len(body)} bytes of it"
        raise ProblemError(HTTPStatus.REQUEST_TIMEOUT, "slow-body", detail, headers=_CLOSE) from None
    if len(body) > settings.max_body:
        await _discard(request)
        raise _too_large(settings)
    return bytes(body)


def _too_large(settings: Settings) -> ProblemError:
    detail = f"expected a body of at most {settings.max_body:,} bytes, got a larger one"
    return ProblemError(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, "body", detail, headers=_CLOSE)


async def _discard(request: Request) -> None:
    """Read on for a while, so that who still sends gets to the answer instead of a broken connection."""
    discarded = 0
    try:
        async with asyncio.timeout(_DISCARDING_SECONDS):
            async for chunk in _rest(request):
                discarded += len(chunk)
                if discarded > _DISCARDED_BYTES:
                    return
    except (TimeoutError, ClientDisconnect):
        return


async def _rest(request: Request) -> AsyncIterator[bytes]:
    """Yield what is still to come; a stream that has been left cannot be taken up again."""
    more = True
    while more:
        message = await request.receive()
        if message["type"] == "http.disconnect":
            return
        more = message.get("more_body", False)
        yield message.get("body", b"")
