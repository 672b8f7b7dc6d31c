"""``/healthz``, ``/readyz`` and ``/metrics``: what those who run a service ask it."""

from http import HTTPStatus

from fastapi import APIRouter
from starlette.requests import Request
from starlette.responses import Response

import nacreous
from nacreous.web.answers import Health, Readiness, document
from nacreous.web.metrics import CONTENT_TYPE_LATEST
from nacreous.web.openapi import answered, open_problems, problems
from nacreous.web.problems import ProblemError
from nacreous.web.queries import query
from nacreous.web.service import service_of

__all__ = ["router"]

router = APIRouter(tags=["operations"])

_NEVER = {"Cache-Control": "no-store"}


@router.get("/healthz", responses=answered(Health, HTTPStatus.OK) | open_problems())
async def healthz(request: Request) -> Response:
    """Tell that the process answers; nothing else is looked at."""
    query(request)
    answer = Health(status="ok", version=nacreous.__version__)
    return Response(document(answer), headers=_NEVER, media_type="application/json")


@router.get("/readyz", responses=answered(Readiness, HTTPStatus.OK) | open_problems())
async def readyz(request: Request) -> Response:
    """Tell whether tables are computed; 503 says why not."""
    query(request)
    service = service_of(request)
    fault = "" if service.stopping.is_set() else await service.store_fault()
    reason = service.reason_not_ready(fault)
    if reason:
        headers = {**_NEVER, "Retry-After": "1"}
        raise ProblemError(HTTPStatus.SERVICE_UNAVAILABLE, "not-ready", reason, headers=headers)
    answer = Readiness(ready=True, engine=service.engine.state.readiness.value, store=fault or "writable")
    return Response(document(answer), headers=_NEVER, media_type="application/json")


@router.get(
    "/metrics",
    responses={
        200: {
            "description": "Counters and gauges, as Prometheus reads them.",
            "content": {"text/plain": {"schema": {"type": "string"}}},
        },
        **problems(),
    },
)
async def metrics(request: Request) -> Response:
    """Get counters and gauges in Prometheus' text format."""
    query(request)
    text = await service_of(request).metrics.text()
    return Response(text, headers={**_NEVER, "Content-Type": CONTENT_TYPE_LATEST})
