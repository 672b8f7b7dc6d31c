"""``/v1/jobs``: sweeps that are computed one table after the other, whether anyone waits or not."""

import asyncio
from collections import defaultdict
from collections.abc import AsyncIterator, Iterable
from contextlib import aclosing
from http import HTTPStatus
from typing import Annotated

from fastapi import APIRouter, Path
from starlette.requests import Request
from starlette.responses import Response, StreamingResponse

from nacreous.engine.files import format_of_suffix
from nacreous.engine.jobs import Job
from nacreous.engine.sweep import Sweep
from nacreous.tables.spec_document import Document
from nacreous.web.admission import admit
from nacreous.web.answers import FailureAnswer, JobAnswer, JobProgress, JobTable, document, json_response
from nacreous.web.bodies import read_document
from nacreous.web.files import split_file_name
from nacreous.web.ids import checked_id
from nacreous.web.links import job_links
from nacreous.web.openapi import HEX_ID, READS_SWEEP, answered, problems, query_parameter
from nacreous.web.queries import query, whole_number
from nacreous.web.service import Service, service_of

__all__ = ["job_answer", "router"]

router = APIRouter(tags=["jobs"])

JobId = Annotated[str, Path(description="64 lower-case hex digits.", json_schema_extra=HEX_ID)]
_EVENTS = "text/event-stream"
_PAGE, _LONGEST_PAGE = 1000, 10_000
_KEEP_ALIVE_SECONDS = 15.0
_PAGED = [
    query_parameter("offset", "Tables to pass over.", {"type": "integer", "minimum": 0, "maximum": 10**9}),
    query_parameter(
        "limit",
        "Tables of an answer.",
        {"type": "integer", "minimum": 0, "maximum": _LONGEST_PAGE, "default": _PAGE},
    ),
]


@router.post(
    "/v1/jobs",
    status_code=HTTPStatus.ACCEPTED,
    responses={
        **answered(JobAnswer, HTTPStatus.ACCEPTED, headers=("Location",)),
        **problems(400, 408, 413, 415, 429, 500),
    },
    openapi_extra=READS_SWEEP,
)
async def add_job(request: Request) -> Response:
    """Compute a sweep: a base, and the product of all that varies. The same sweep is the same job."""
    service = service_of(request)
    query(request)
    document_of_sweep = await read_document(request, service.settings)
    sweep = await asyncio.to_thread(_sweep, document_of_sweep, service.settings.job_tables)
    job = await service.jobs.add(sweep)
    headers = {"Location": job_links(job)["self"]}
    return Response(document(job_answer(job)), HTTPStatus.ACCEPTED, headers, "application/json")


def _sweep(document_of_sweep: Document, limit: int) -> Sweep:
    """Return the sweep of a document, whose first table can be computed."""
    sweep = Sweep.from_document(document_of_sweep, limit)
    for work in sweep[0]:
        admit(work)
    return sweep


@router.get(
    "/v1/jobs/{job_id}",
    responses={**answered(JobAnswer, HTTPStatus.OK), **problems(404)},
    openapi_extra={"parameters": _PAGED},
)
async def job(request: Request, job_id: JobId) -> Response:
    """Get how far a job is, and the tables that it has finished."""
    parameters = query(request, ("offset", "limit"))
    offset = whole_number(parameters, "offset", 0, 10**9)
    limit = whole_number(parameters, "limit", _PAGE, _LONGEST_PAGE)
    found = await service_of(request).jobs.get(checked_id(job_id, "job"))
    return json_response(job_answer(found, offset, limit), request.scope)


@router.delete("/v1/jobs/{job_id}", responses={**answered(JobAnswer, HTTPStatus.OK), **problems(404)})
async def cancel_job(request: Request, job_id: JobId) -> Response:
    """Cancel a job; the tables that it has finished stay, and one that has ended is left alone."""
    query(request)
    cancelled = await service_of(request).jobs.cancel(checked_id(job_id, "job"))
    return Response(document(job_answer(cancelled)), media_type="application/json")


@router.get(
    "/v1/jobs/{job_id}/events",
    responses={
        200: {
            "description": "A job's progress at every change; the stream ends with the job.",
            "content": {_EVENTS: {}},
        },
        **problems(404),
    },
)
async def job_events(request: Request, job_id: JobId) -> Response:
    """Follow a job: server-sent events named progress, whose data is the job without its tables."""
    query(request)
    service = service_of(request)
    found = await service.jobs.get(checked_id(job_id, "job"))
    headers = {"Cache-Control": "no-store"}
    events = _once(found) if request.scope.get("nacreous.head") else _events(service, found.id)
    return StreamingResponse(events, media_type=_EVENTS, headers=headers)


async def _once(found: Job) -> AsyncIterator[bytes]:
    yield _event(found)


async def _events(service: Service, job_id: str) -> AsyncIterator[bytes]:
    """Yield an event for each change, and a comment now and then so that proxies keep the connection."""
    async with aclosing(service.jobs.events(job_id)) as changes:  # type: ignore[type-var]
        following: asyncio.Future[Job] = asyncio.ensure_future(anext(changes))
        stopping = asyncio.ensure_future(service.stopping.wait())
        try:
            while not stopping.done():
                first = asyncio.FIRST_COMPLETED
                await asyncio.wait((following, stopping), timeout=_KEEP_ALIVE_SECONDS, return_when=first)
                if not following.done():
                    yield b": still here\n\n"
                    continue
                yield _event(following.result())
                following = asyncio.ensure_future(anext(changes))
        except StopAsyncIteration:
            return
        finally:
            for task in (following, stopping):
                task.cancel()
            await asyncio.gather(following, stopping, return_exceptions=True)


def _event(found: Job) -> bytes:
    return b"event: progress\ndata: " + document(_progress(found)) + b"\n\n"


def _progress(found: Job) -> JobProgress:
    return JobProgress(**_fields(found))


def job_answer(found: Job, offset: int = 0, limit: int = _PAGE) -> JobAnswer:
    """Return a job as it is answered, with a page of its finished tables."""
    page = slice(offset, offset + limit)
    links = _links_of(found.files)
    tables = [
        JobTable(spec=spec, id=table_id, links=links[table_id])
        for spec, table_id in zip(found.specs[page], found.tables[page], strict=True)
    ]
    return JobAnswer(**_fields(found), tables=tables)


def _fields(found: Job) -> dict[str, object]:
    return {
        "id": found.id,
        "state": found.state.value,
        "done": found.done,
        "failed": found.failed,
        "total": found.total,
        "fraction": found.fraction,
        "failures": [FailureAnswer(spec=each.spec, message=each.message) for each in found.failures],
        "created": found.created.isoformat(),
        "formats": list(found.formats),
        "error": found.error or None,
        "links": job_links(found),
    }


def _links_of(files: Iterable[str]) -> dict[str, dict[str, str]]:
    """Return the links of each table: itself, and its finished files by format."""
    links: dict[str, dict[str, str]] = defaultdict(dict)
    for name in files:
        table_id, suffix = split_file_name(name)
        found = links[table_id]
        found["self"] = f"/v1/tables/{table_id}"
        chosen = format_of_suffix(suffix)
        if chosen.suffix == suffix:
            found[chosen.name.value] = f"/v1/tables/{name}"
    return links
