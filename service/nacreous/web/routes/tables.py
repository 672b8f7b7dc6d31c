"""``/v1/tables``: a spec becomes a table, and a table becomes files."""

from http import HTTPStatus
from typing import Annotated

from fastapi import APIRouter, Path
from starlette.requests import Request
from starlette.responses import Response

from nacreous.engine.cost import estimated_seconds
from nacreous.engine.files import SUFFIXES, default_format, format_of_suffix
from nacreous.engine.sweep import Sweep
from nacreous.engine.work import Work
from nacreous.errors import MissingError, SpecError
from nacreous.formats.registry import FORMATS
from nacreous.tables.spec import Spec
from nacreous.web.admission import admit
from nacreous.web.answers import JobAccepted, TableAdded, TableAnswer, document, json_response
from nacreous.web.bodies import read_document
from nacreous.web.files import file_response, representation, split_file_name
from nacreous.web.hot_files import TABLE_FILE
from nacreous.web.ids import checked_id
from nacreous.web.links import table_links
from nacreous.web.openapi import (
    CONDITIONS,
    HEX_ID,
    READS_SPEC,
    answered,
    binary,
    operation_link,
    problems,
    query_parameter,
)
from nacreous.web.queries import chosen_word, query
from nacreous.web.routes.jobs import job_answer
from nacreous.web.service import Service, service_of

__all__ = ["Suffix", "job_of", "router"]

router = APIRouter(tags=["tables"])

TableId = Annotated[str, Path(description="64 lower-case hex digits.", json_schema_extra=HEX_ID)]
_ENDINGS = [suffix.removeprefix(".") for suffix in SUFFIXES]
Suffix = Annotated[str, Path(description="By format.", json_schema_extra={"enum": _ENDINGS})]
_LOCATION = ("Location",)
_LINKS = {
    "table": operation_link("/v1/tables/{table_id}", table_id="$response.body#/id"),
    "file": operation_link(TABLE_FILE, table_id="$response.body#/id", suffix="npz"),
}
_WAYS = (_QUEUED, _REFUSED) = ("job", "refuse")
_LONG = query_parameter(
    "long",
    "What becomes of a spec that takes long: a job, or 422, for a client that shows a film while it changes.",
    {"enum": [*_WAYS], "default": _QUEUED},
)


@router.post(
    "/v1/tables",
    status_code=HTTPStatus.CREATED,
    responses={
        **answered(TableAdded, HTTPStatus.CREATED, HTTPStatus.OK, headers=_LOCATION, links=_LINKS),
        **answered(JobAccepted, HTTPStatus.ACCEPTED, headers=_LOCATION),
        **problems(400, 408, 413, 415, 429, 500, 504),
    },
    openapi_extra={**READS_SPEC, "parameters": [_LONG]},
)
async def add_table(request: Request) -> Response:
    """Tabulate a spec: 201 for a new table, 200 for a known one, 202 and a job for one that takes long."""
    service = service_of(request)
    long = chosen_word(query(request, ("long",)), "long", _WAYS)
    spec = Spec.from_document(await read_document(request, service.settings))
    work = Work(spec, default_format(spec))
    admit(work)
    seconds, most = estimated_seconds(work), service.settings.synchronous_seconds
    if seconds > most and not await _is_known(service, work):
        if long == _REFUSED:
            raise _takes_long(seconds, most)
        return await job_of(service, work)
    added = await service.library.add(spec)
    links = table_links(added.id, spec)
    answer = TableAdded(id=added.id, created=added.created, certificate=dict(added.certificate), links=links)
    status = HTTPStatus.CREATED if added.created else HTTPStatus.OK
    return _json(document(answer), status, links["self"])


def _takes_long(seconds: float, most: float) -> SpecError:
    expected = f"a table that takes at most {most:g} s, for a request that wants no job"
    return SpecError("table", expected, f"an estimated {seconds:.3g} s", "leave long=refuse out for a job")


async def _is_known(service: Service, work: Work) -> bool:
    try:
        await service.library.record(work.id)
    except MissingError:
        return False
    return True


async def job_of(service: Service, work: Work) -> Response:
    """Put one work in the queue of the jobs, and answer 202."""
    job = await service.jobs.add(Sweep.of(work.spec, (work.format.value,)))
    links = {"job": f"/v1/jobs/{job.id}", "table": f"/v1/tables/{work.id}"}
    answer = JobAccepted(job=job_answer(job), links=links)
    return _json(document(answer), HTTPStatus.ACCEPTED, links["job"])


def _json(body: bytes, status: HTTPStatus, location: str) -> Response:
    return Response(body, status, {"Location": location}, "application/json")


@router.get(
    TABLE_FILE,
    responses={
        **binary(*sorted({entry.media_type for entry in FORMATS.values()})),
        **answered(JobAccepted, HTTPStatus.ACCEPTED, headers=_LOCATION),
    },
    openapi_extra={"parameters": CONDITIONS},
)
async def table_file(
    request: Request,
    table_id: TableId,
    suffix: Suffix,
) -> Response:
    """Get a file of a table: immutable, with its SHA-256 as ETag; ranges and If-None-Match are heeded.

    A format that has not been asked for before is computed. Where that takes longer than a request may, a
    job does it, and the answer is 202.
    """
    service = service_of(request)
    query(request)
    # A suffix may hold dots, at the first of which the id ends.
    stem, ending = split_file_name(f"{table_id}.{suffix}")
    known = checked_id(stem, "table")
    chosen = format_of_suffix(ending)
    if service.library.hot(known, ending) is None:
        work = Work((await service.library.record(known)).spec, chosen.name)
        admit(work)
        too_long = estimated_seconds(work) > service.settings.deadline_seconds
        if too_long and not await service.library.holds(work, ending):
            return await job_of(service, work)
    entry = await service.library.table_file(known, ending)
    return await file_response(
        representation(entry, known, ending, service.cache_control), chosen, request.scope
    )


@router.get("/v1/tables/{table_id}", responses={**answered(TableAnswer, HTTPStatus.OK), **problems(404)})
async def table(request: Request, table_id: TableId) -> Response:
    """Get what is known of a table: its spec, its certificate, and where its files are."""
    query(request)
    record = await service_of(request).library.record(checked_id(table_id, "table"))
    answer = TableAnswer(
        id=record.id,
        spec=record.spec.model_dump(mode="json"),
        certificate=dict(record.certificate),
        links=table_links(record.id, record.spec),
    )
    return json_response(answer, request.scope)
