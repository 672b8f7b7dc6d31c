"""From an entry of the library to an answer: names, types, and who may keep it for how long."""

import asyncio

from starlette.responses import Response
from starlette.types import Scope

from nacreous.errors import MissingError
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS, Format
from nacreous.optics.value import shown
from nacreous.store.entry import Entry
from nacreous.web.caching import FileResponse, Representation, compressed
from nacreous.web.links import TRANSMISSION

__all__ = ["COMPRESSED", "SUFFIXES", "file_response", "format_of_suffix", "representation", "split_file_name"]

COMPRESSED = frozenset({FormatName.CSV, FormatName.MATERIALX, FormatName.GLTF})
"""Formats of text; all others are compressed already, or do not become smaller."""

_COMPANIONS = (FormatName.EXR, FormatName.SPECTRAL_EXR, FormatName.PNG)
_BY_SUFFIX = {entry.suffix: entry for entry in FORMATS.values()}
_BY_SUFFIX |= {f"{TRANSMISSION}{FORMATS[name].suffix}": FORMATS[name] for name in _COMPANIONS}


SUFFIXES = tuple(suffix.removeprefix(".") for suffix in _BY_SUFFIX)
"""What the name of a file may end in."""


def split_file_name(name: str) -> tuple[str, str]:
    """Return what comes before the first dot of a path's last part, and the suffix with its dot.

    >>> split_file_name("paper/figure-3.transmission.exr")
    ('paper/figure-3', '.transmission.exr')
    """
    folder, slash, last = name.rpartition("/")
    stem, dot, suffix = last.partition(".")
    return f"{folder}{slash}{stem}", f"{dot}{suffix}"


def format_of_suffix(suffix: str) -> Format:
    """Return the format of files with this suffix; raises `MissingError` with those that there are."""
    try:
        return _BY_SUFFIX[suffix]
    except KeyError:
        known = ", ".join(_BY_SUFFIX)
        raise MissingError(f"expected a file name that ends in {known}, got {shown(suffix)}") from None


def representation(entry: Entry, stem: str, suffix: str, cache_control: bytes) -> Representation:
    """Return an entry as bytes that can be answered."""
    media_type = str(entry.facts.get("media_type", "application/octet-stream"))
    return Representation(entry.payload, entry.sha256, media_type, cache_control, f"{stem}{suffix}")


async def file_response(file: Representation, chosen: Format, scope: Scope) -> Response:
    """Return the answer: compressed in a thread where the format is text and the client takes it."""
    if chosen.name not in COMPRESSED:
        return FileResponse(file)
    return FileResponse(await asyncio.to_thread(compressed, file, scope))
