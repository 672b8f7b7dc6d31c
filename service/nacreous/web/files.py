"""From an entry of the library to an answer: names, types, and who may keep it for how long."""

import asyncio

from starlette.responses import Response
from starlette.types import Scope

from nacreous.formats.names import FormatName
from nacreous.formats.registry import Format
from nacreous.store.entry import Entry
from nacreous.web.caching import FileResponse, Representation, compressed

__all__ = ["COMPRESSED", "file_response", "representation", "split_file_name"]

COMPRESSED = frozenset({FormatName.CSV, FormatName.MATERIALX, FormatName.GLTF})
"""Formats of text; all others are compressed already, or do not become smaller."""


def split_file_name(name: str) -> tuple[str, str]:
    """Return what comes before the first dot of a path's last part, and the suffix with its dot.

    >>> split_file_name("paper/figure-3.transmission.exr")
    ('paper/figure-3', '.transmission.exr')
    """
    folder, slash, last = name.rpartition("/")
    stem, dot, suffix = last.partition(".")
    return f"{folder}{slash}{stem}", f"{dot}{suffix}"


def representation(entry: Entry, stem: str, suffix: str, cache_control: bytes) -> Representation:
    """Return an entry as bytes that can be answered."""
    media_type = str(entry.facts.get("media_type", "application/octet-stream"))
    return Representation(entry.payload, entry.sha256, media_type, cache_control, f"{stem}{suffix}")


async def file_response(file: Representation, chosen: Format, scope: Scope) -> Response:
    """Return the answer: compressed in a thread where the format is text and the client takes it."""
    if chosen.name not in COMPRESSED:
        return FileResponse(file)
    return FileResponse(await asyncio.to_thread(compressed, file, scope))
