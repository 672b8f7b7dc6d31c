"""``/``: a plain page for whoever opens the service in a browser."""

from functools import cache
from html import escape

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import HTMLResponse, Response

from nacreous.tables.presets import preset, preset_names
from nacreous.web.links import preset_links

__all__ = ["router"]

router = APIRouter()

_HEADERS = {
    "Content-Security-Policy": "default-src 'none'; style-src 'unsafe-inline'; img-src 'self'; "
    "frame-ancestors 'none'; base-uri 'none'; form-action 'none'",
    "Cache-Control": "no-cache",
}
_PAGE = """\
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
<h2>Presets</h2>
<dl>
{entries}
</dl>
</html>
"""


@router.get("/", include_in_schema=False)
async def page(_: Request) -> Response:
    """Answer the page."""
    return HTMLResponse(_rendered(), headers=_HEADERS)


@cache
def _rendered() -> str:
    return _PAGE.format(entries="\n".join(map(_entry, preset_names())))


def _entry(name: str) -> str:
    spec = preset(name)
    files = " · ".join(
        f'<a href="{escape(url.removeprefix("/"))}">{escape(kind)}</a>'
        for kind, url in preset_links(name, spec).items()
    )
    return f"<dt>{escape(spec.name or name)}</dt><dd>{escape(spec.description)}</dd><dd>{files}</dd>"
