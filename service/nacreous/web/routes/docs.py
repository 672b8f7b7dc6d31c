"""``/docs``: the routes in Swagger UI, whose script and style this service sends itself.

FastAPI's own page loads them from elsewhere; nothing of this service does that.
"""

from collections.abc import Awaitable, Callable
from importlib.resources import as_file, files

from fastapi.openapi.docs import get_swagger_ui_html
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import BaseRoute, Mount, Route
from starlette.staticfiles import StaticFiles

__all__ = ["docs_routes"]

_ASSETS = "/docs/assets"


def docs_routes(openapi_url: str) -> list[BaseRoute]:
    """Return the route of the page, and that of what it loads."""
    with as_file(files("fastapi_offline").joinpath("static")) as folder:
        return [Route("/docs", _page(openapi_url)), Mount(_ASSETS, StaticFiles(directory=folder))]


def _page(openapi_url: str) -> Callable[[Request], Awaitable[Response]]:
    html = get_swagger_ui_html(
        openapi_url=openapi_url,
        title="Nacreous",
        swagger_js_url=f"{_ASSETS}/swagger-ui-bundle.js",
        swagger_css_url=f"{_ASSETS}/swagger-ui.css",
        swagger_favicon_url=f"{_ASSETS}/favicon.png",
    )

    async def docs(_: Request) -> Response:
        return html

    return docs
