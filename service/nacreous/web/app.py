"""The service as an ASGI application: `create_app` puts the routes and the layers around them together."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from http import HTTPStatus

from fastapi import FastAPI
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Match
from starlette.types import ASGIApp, Receive, Scope, Send

import nacreous
from nacreous.engine.engine import Engine
from nacreous.opencl.budget import byte_budget
from nacreous.optics.value import shown
from nacreous.web.cors import Cors
from nacreous.web.engines import worker_engine
from nacreous.web.hot_files import HotFiles
from nacreous.web.keys import Keys
from nacreous.web.limits import Limits
from nacreous.web.observation import HeadAsGet, Observed, Problems
from nacreous.web.openapi import use_openapi
from nacreous.web.problems import Problem
from nacreous.web.routes import jobs, materials, operations, presets, tables
from nacreous.web.routes.docs import docs_routes
from nacreous.web.routes.page import BUILT_PAGE, page_routes
from nacreous.web.service import Service, make_service
from nacreous.web.settings import Settings

__all__ = ["create_app"]

_DESCRIPTION = """\
Tabulated BSDFs of thin-film interference: a spec becomes a table, and a table becomes files that renderers
load. Errors are problem+json (RFC 9457). Every GET is answered to HEAD as well."""

_ROUTERS = (tables.router, presets.router, materials.router, jobs.router, operations.router)


def create_app(settings: Settings, engine: Engine | None = None) -> FastAPI:
    """Return the service of these settings.

    Parameters
    ----------
    settings : Settings
    engine : Engine, optional
        Computes the tables; a supervised worker process without one.

    Raises
    ------
    SpecError
        ``NACREOUS_BYTE_BUDGET`` is no size.
    """
    byte_budget()
    service = make_service(settings, engine or worker_engine(settings))
    app = _Layered(
        title="Nacreous",
        version=nacreous.__version__,
        description=_DESCRIPTION,
        lifespan=_lifespan,
        docs_url=None,
        redoc_url=None,
        redirect_slashes=False,
    )
    app.state.service = service
    for router in _ROUTERS:
        app.router.routes.extend(router.routes)  # one list: what a path answers to is looked up in it
    app.router.routes.extend(docs_routes(app.openapi_url or ""))
    app.router.routes.extend(page_routes(BUILT_PAGE))
    app.add_exception_handler(HTTPException, _http_problem)
    app.add_exception_handler(RequestValidationError, _validation_problem)
    app.add_middleware(Problems)  # FastAPI answers 500 where an error leaves it; `_layers` has its own errors
    app.state.layers = _layers(app, service)
    use_openapi(app)
    return app


@asynccontextmanager
async def _lifespan(app: FastAPI) -> AsyncIterator[None]:
    service: Service = app.state.service
    await service.start()
    try:
        yield
    finally:
        await service.stop()


class _Layered(FastAPI):
    """FastAPI with layers around all of it: a file in memory is answered before its own are entered."""

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request through the layers; the life of the app goes its own way."""
        if scope["type"] == "http":
            await self.state.layers(scope, receive, send)
        else:
            await self.within(scope, receive, send)

    async def within(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer by the routes."""
        await super().__call__(scope, receive, send)


def _layers(app: _Layered, service: Service) -> ASGIApp:
    """Return the routes with the layers around them, put on from the innermost."""
    settings = service.settings
    layers: ASGIApp = HotFiles(app.within, service.library, service.cache_control)
    layers = Limits(HeadAsGet(layers), service)
    if settings.keys:
        layers = Keys(layers, settings.keys)
    layers = Problems(layers)
    if settings.cors_origins:
        layers = Cors(layers, settings.cors_origins)
    return Observed(layers, service.metrics)


async def _http_problem(request: Request, error: Exception) -> Response:
    """Answer what the router refuses: an unknown path, or a method that a path does not have."""
    status = HTTPStatus(getattr(error, "status_code", HTTPStatus.INTERNAL_SERVER_ERROR))
    if status is HTTPStatus.METHOD_NOT_ALLOWED:
        allowed = ", ".join(_methods(request))
        detail = f"expected one of {allowed} here, got {shown(request.method)}"
        return Problem(status, "method", detail, headers={"Allow": allowed}).response()
    if status is HTTPStatus.NOT_FOUND:
        detail = f"expected a path that /docs describes, got {shown(request.url.path)}"
        return Problem(status, "missing", detail).response()
    return Problem(status, "http", status.phrase).response()


def _methods(request: Request) -> list[str]:
    """Return every method that some route of this path has."""
    found: set[str] = set()
    for route in request.app.routes:
        match, _ = route.matches(dict(request.scope))
        if match is not Match.NONE:
            found |= set(getattr(route, "methods", None) or ())
    return sorted(found | ({"HEAD"} if "GET" in found else set()))


async def _validation_problem(_: Request, error: Exception) -> Response:
    """Answer what FastAPI refuses, without what it was; routes read parameters and bodies by themselves."""
    found = error.errors() if isinstance(error, RequestValidationError) else []
    where = ".".join(str(part) for first in found[:1] for part in first["loc"])
    status = HTTPStatus.UNPROCESSABLE_ENTITY
    return Problem(status, "request", f"the request cannot be used: {shown(where)}").response()
