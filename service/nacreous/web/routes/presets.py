"""``/v1/presets``: specs that come with Nacreous, and links to their files that anyone can paste."""

from functools import cache
from http import HTTPStatus
from typing import Annotated

from fastapi import APIRouter, Path
from starlette.requests import Request
from starlette.responses import Response

from nacreous.engine.files import format_of_suffix
from nacreous.formats.registry import FORMATS
from nacreous.tables.identity import table_id
from nacreous.tables.presets import preset, preset_names
from nacreous.web.answers import JobAccepted, PresetAnswer, PresetEntry, PresetList, document, json_file
from nacreous.web.caching import REVALIDATE
from nacreous.web.files import file_response, representation, split_file_name
from nacreous.web.links import preset_links
from nacreous.web.openapi import CONDITIONS, answered, binary, problems, query_parameter
from nacreous.web.presets import check_preset, preset_work
from nacreous.web.queries import query
from nacreous.web.routes.tables import Suffix, job_of
from nacreous.web.service import service_of

__all__ = ["router"]

router = APIRouter(tags=["presets"])

PresetName = Annotated[
    str,
    Path(description="Such as soap-bubble or paper/figure-3.", json_schema_extra={"enum": [*preset_names()]}),
]
_SCALE = query_parameter(
    "thickness_scale",
    "A number: one factor on every layer's thickness, for a table of that one film. Or the axis of the "
    "table, written as in a spec: [0.5, 1] or { start = 0.5, stop = 1, count = 8 }.",
    {"anyOf": [{"type": "number", "minimum": 1e-6, "maximum": 100}, {"type": "string"}]},
)


@router.get("/v1/presets", responses=answered(PresetList, HTTPStatus.OK) | problems())
async def presets(request: Request) -> Response:
    """List the presets: what each shows, whose numbers it has, and where its files are."""
    query(request)
    return json_file(_listed(), request.scope)


@cache
def _listed() -> bytes:
    return document(PresetList([PresetEntry(**_entry(name)) for name in preset_names()]))


@cache
def _described(name: str) -> bytes:
    spec = preset(name)
    answer = PresetAnswer(**_entry(name), id=table_id(spec), spec=spec.model_dump(mode="json"))
    return document(answer)


def _entry(name: str) -> dict[str, object]:
    spec = preset(name)
    return {
        "name": name,
        "title": spec.name,
        "description": spec.description,
        "source": spec.source,
        "quantity": spec.table.quantity,
        "links": preset_links(name, spec),
    }


@router.get(
    "/v1/presets/{name:path}.{suffix}",
    responses={
        **binary(*sorted({entry.media_type for entry in FORMATS.values()})),
        **answered(JobAccepted, HTTPStatus.ACCEPTED, headers=("Location",)),
    },
    openapi_extra={"parameters": [*CONDITIONS, _SCALE]},
)
async def preset_file(
    request: Request,
    name: PresetName,
    suffix: Suffix,
) -> Response:
    """Get a file of a preset, as it is or with its layers thicker or thinner; otherwise as a table's file."""
    service = service_of(request)
    scale = query(request, ("thickness_scale",)).get("thickness_scale", "")
    stem, ending = split_file_name(f"{name}.{suffix}")
    check_preset(stem)
    chosen = format_of_suffix(ending)
    work, seconds = preset_work(stem, chosen.name, scale)
    wanted = "" if ending == chosen.suffix else ending
    if seconds > service.settings.deadline_seconds and not await service.library.holds(work, wanted):
        return await job_of(service, work)
    entry = await service.library.file(work, wanted)
    return await file_response(representation(entry, work.name, ending, REVALIDATE), chosen, request.scope)


@router.get("/v1/presets/{name:path}", responses={**answered(PresetAnswer, HTTPStatus.OK), **problems(404)})
async def described_preset(request: Request, name: PresetName) -> Response:
    """Get a preset with its spec."""
    query(request)
    check_preset(name)
    return json_file(_described(name), request.scope)
