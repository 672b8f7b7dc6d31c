"""``/v1/materials``: names that can stand for a refractive index in a spec, and what is behind them."""

import asyncio
from http import HTTPStatus
from typing import Annotated

from fastapi import APIRouter, Path
from starlette.requests import Request
from starlette.responses import Response

from nacreous.errors import MissingError, SpecError
from nacreous.optics.value import shown
from nacreous.web.answers import MaterialAnswer, MaterialList, json_response
from nacreous.web.materials import describe, find
from nacreous.web.openapi import answered, problems, query_parameter
from nacreous.web.queries import query, whole_number

__all__ = ["router"]

router = APIRouter(tags=["materials"])

_PAGE, _LONGEST_PAGE = 100, 4000
_LONGEST_NAME = 200
_PARAMETERS = [
    query_parameter("search", "Words, all of which must occur.", {"type": "string", "maxLength": 200}),
    query_parameter(
        "offset", "Materials to pass over.", {"type": "integer", "minimum": 0, "maximum": 1_000_000}
    ),
    query_parameter(
        "limit",
        "Materials of an answer.",
        {"type": "integer", "minimum": 0, "maximum": _LONGEST_PAGE, "default": _PAGE},
    ),
]


@router.get(
    "/v1/materials",
    responses=answered(MaterialList, HTTPStatus.OK) | problems(),
    openapi_extra={"parameters": _PARAMETERS},
)
async def materials(request: Request) -> Response:
    """Find materials whose name, description or citation holds every word; all of them without any."""
    parameters = query(request, ("search", "offset", "limit"))
    text = parameters.get("search", "")
    if len(text) > _LONGEST_NAME:
        raise SpecError("search", f"at most {_LONGEST_NAME} characters", f"{len(text)}")
    offset = whole_number(parameters, "offset", 0, 1_000_000)
    limit = whole_number(parameters, "limit", _PAGE, _LONGEST_PAGE)
    return json_response(await asyncio.to_thread(find, text, offset, limit), request.scope)


@router.get(
    "/v1/materials/{name:path}", responses={**answered(MaterialAnswer, HTTPStatus.OK), **problems(404)}
)
async def material(
    request: Request, name: Annotated[str, Path(description="Such as water, or main/Ag/Johnson.")]
) -> Response:
    """Get a material: its source, its range, and n and k over it."""
    query(request)
    if len(name) > _LONGEST_NAME:
        raise MissingError(f"expected the name of a material, got {shown(name)}")
    return json_response(await asyncio.to_thread(describe, name), request.scope)
