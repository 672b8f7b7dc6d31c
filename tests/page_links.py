"""Links to films on the service's page, made without any of the page's own code."""

import base64
import json
import zlib
from typing import Any

__all__ = ["film_fragment", "link_contents"]

_RAW = -15
"""Window bits of zlib for a stream without header and checksum: RFC 1951."""


def film_fragment(spec: dict[str, Any], /, **view: str | float) -> str:
    """Return the fragment of a link to a film and how it is looked at."""
    packer = zlib.compressobj(wbits=_RAW)
    packed = packer.compress(json.dumps({"spec": spec, "view": view}).encode()) + packer.flush()
    return f"film={base64.urlsafe_b64encode(packed).decode().rstrip('=')}"


def link_contents(url: str) -> dict[str, Any]:
    """Return what a link to a film holds."""
    text = url.partition("#film=")[2]
    packed = base64.urlsafe_b64decode(text + "=" * (-len(text) % 4))
    contents: dict[str, Any] = json.loads(zlib.decompress(packed, wbits=_RAW))
    return contents
