"""``/`` and ``/assets/``: the page for whoever opens the service in a browser, as `service/page` builds it.

Its files are in memory, and only those are answered: no request becomes a path. Where none was built, as in
a checkout that was never installed, a plain one lists the presets and says how to build it.
"""

import hashlib
import mimetypes
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, replace
from functools import cache
from html import escape
from http import HTTPStatus
from pathlib import Path

from starlette.requests import Request
from starlette.responses import HTMLResponse, Response
from starlette.routing import BaseRoute, Route

from nacreous.optics.value import shown
from nacreous.tables.presets import preset, preset_names
from nacreous.web.caching import IMMUTABLE, FileResponse, RawHeaders, Representation, takes_gzip
from nacreous.web.links import preset_links
from nacreous.web.problems import ProblemError

__all__ = ["BUILT_PAGE", "page_routes"]

BUILT_PAGE = Path(__file__).parents[1] / "page"
"""Where service/page/build.py puts the page."""

_POLICY = (
    b"default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; "
    b"font-src 'self'; worker-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
_MEDIA_TYPES = {".js": "text/javascript", ".wasm": "application/wasm"}
"""Not left to the tables of the machine, which say other things of them."""
_UNHASHED = b"no-cache"
"""Cache-Control of what keeps its name when the page changes."""

_Endpoint = Callable[[Request], Awaitable[Response]]


def page_routes(folder: Path) -> list[BaseRoute]:
    """Return the routes of the page that was built into a folder, or those of the plain one."""
    if not (folder / "index.html").is_file():
        return [Route("/", _plain_page, include_in_schema=False)]
    document = _Document(**vars(_identity(folder / "index.html", _UNHASHED)))
    index = _Forms(document, _gzipped(folder / "index.html", document))
    assets = {path.name: _forms(path) for path in (folder / "assets").iterdir() if path.suffix != ".gz"}
    return [
        Route("/", _answering(index), include_in_schema=False),
        Route("/assets/{name}", _answering_one_of(assets), include_in_schema=False),
    ]


@dataclass(frozen=True)
class _Document(Representation):
    """The document that a browser shows, with what it may load."""

    def headers(self) -> RawHeaders:
        """Return those of every file, and the policy."""
        return [*super().headers(), (b"content-security-policy", _POLICY)]


@dataclass(frozen=True)
class _Forms:
    """A file as it is, and as gzip has it where that was built."""

    identity: Representation
    gzipped: Representation | None

    def response(self, request: Request) -> FileResponse:
        """Return the form that the client takes; a range is one of the file as it is."""
        if self.gzipped is None or "range" in request.headers or not takes_gzip(request.scope):
            return FileResponse(self.identity)
        return FileResponse(self.gzipped)


def _forms(path: Path) -> _Forms:
    identity = _identity(path, IMMUTABLE)
    return _Forms(identity, _gzipped(path, identity))


def _identity(path: Path, cache_control: bytes) -> Representation:
    payload = path.read_bytes()
    return Representation(
        payload=payload,
        tag=hashlib.sha256(payload).hexdigest(),
        media_type=_media_type(path),
        cache_control=cache_control,
        varies=b"Accept-Encoding",
    )


def _gzipped(path: Path, identity: Representation) -> Representation | None:
    built = path.with_name(f"{path.name}.gz")
    if not built.is_file():
        return None
    return replace(identity, payload=built.read_bytes(), tag=f"{identity.tag}-gzip", encoding="gzip")


def _media_type(path: Path) -> str:
    found = _MEDIA_TYPES.get(path.suffix) or mimetypes.guess_type(path.name)[0] or "application/octet-stream"
    return f"{found}; charset=utf-8" if found.startswith("text/") else found


def _answering(file: _Forms) -> _Endpoint:
    async def answer(request: Request) -> Response:
        return file.response(request)

    return answer


def _answering_one_of(files: dict[str, _Forms]) -> _Endpoint:
    async def answer(request: Request) -> Response:
        name = request.path_params["name"]
        if name not in files:
            detail = f"expected a file that the page at / names, got {shown(name)}"
            raise ProblemError(HTTPStatus.NOT_FOUND, "missing", detail)
        return files[name].response(request)

    return answer


_PLAIN_HEADERS = {
    "Content-Security-Policy": "default-src 'none'; style-src 'unsafe-inline'; img-src 'self'; "
    "frame-ancestors 'none'; base-uri 'none'; form-action 'none'",
    "Cache-Control": "no-cache",
}
_PLAIN = """\
<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>Nacreous</title>
<style>
body {{ font: 1rem/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem }}
dt {{ font-weight: 600; margin-top: 1rem }}
dd {{ margin: 0 }}
</style>
<h1>Nacreous</h1>
<p>Tabulated BSDFs of thin-film interference. The interface is described at <a href="docs">/docs</a>.</p>
<p>The page that shows films and changes them has not been built in this checkout:
<code>python service/page/build.py</code> does so, and so does every installation.</p>
<h2>Presets</h2>
<dl>
{entries}
</dl>
</html>
"""


async def _plain_page(_: Request) -> Response:
    return HTMLResponse(_rendered(), headers=_PLAIN_HEADERS)


@cache
def _rendered() -> str:
    return _PLAIN.format(entries="\n".join(map(_entry, preset_names())))


def _entry(name: str) -> str:
    spec = preset(name)
    files = " · ".join(
        f'<a href="{escape(url.removeprefix("/"))}">{escape(kind)}</a>'
        for kind, url in preset_links(name, spec).items()
    )
    return f"<dt>{escape(spec.name or name)}</dt><dd>{escape(spec.description)}</dd><dd>{files}</dd>"
