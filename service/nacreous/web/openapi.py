"""What OpenAPI says of the routes: bodies, parameters and answers, each from the one place that defines it.

Bodies are read by `nacreous.web.bodies` and not by FastAPI, so that their schema is put beside the routes:
that of a spec is `Spec`'s own.
"""

from collections.abc import Mapping
from http import HTTPStatus
from types import MappingProxyType
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from pydantic import BaseModel

from nacreous.engine.sweep import Sweep
from nacreous.formats.names import FormatName
from nacreous.tables.presets import preset_names
from nacreous.tables.spec import Spec, with_bounds
from nacreous.web.answers import ProblemAnswer
from nacreous.web.examples import SPEC_IN_TOML, SPECS, SWEEPS
from nacreous.web.problems import MEDIA_TYPE

__all__ = [
    "CONDITIONS",
    "HEX_ID",
    "READS_SPEC",
    "READS_SWEEP",
    "answered",
    "binary",
    "open_problems",
    "operation_link",
    "problems",
    "query_parameter",
    "use_openapi",
]

_REF = "#/components/schemas/{model}"
HEX_ID = {"pattern": "^[0-9a-f]{64}$"}

Extra = dict[str, Any]
Responses = dict[int | str, dict[str, Any]]


def answered(
    model: type[BaseModel],
    *statuses: HTTPStatus,
    headers: tuple[str, ...] = (),
    links: Mapping[str, Any] = MappingProxyType({}),
) -> Responses:
    """Return the entry of an answer in JSON, with its headers and with where its values lead."""
    described = {name: {"schema": {"type": "string"}} for name in headers}
    extras = {"headers": described, "links": dict(links)}
    return {
        status.value: {
            "model": model,
            "description": (model.__doc__ or "").strip(),
            **{name: extra for name, extra in extras.items() if extra},
        }
        for status in statuses
    }


def operation_link(path: str, **parameters: str) -> dict[str, Any]:
    """Return the entry of a link: the GET of a path, with values of the answer as its parameters."""
    escaped = path.replace("~", "~0").replace("/", "~1")
    return {"operationRef": f"#/paths/{escaped}/get", "parameters": parameters}


def problems(*statuses: int) -> Responses:
    """Return the entries of problems; 401 and 503 are possible wherever a route wants a key."""
    return open_problems(*statuses, 401)


def open_problems(*statuses: int) -> Responses:
    """Return the entries of the problems of a route that wants no key; 503 is possible there, too."""
    return {
        status: {
            "description": HTTPStatus(status).phrase,
            "content": {MEDIA_TYPE: {"schema": {"$ref": _REF.format(model=ProblemAnswer.__name__)}}},
        }
        for status in sorted({*statuses, 422, 431, 503})
    }


def binary(*media_types: str) -> Responses:
    """Return the entries of a file: whole, a range of it, not changed, and a range that it has not."""
    content = {media_type: {"schema": {"type": "string", "format": "binary"}} for media_type in media_types}
    tag = {"ETag": {"description": "SHA-256 of the file, in quotes.", "schema": {"type": "string"}}}
    return {
        200: {"description": "The file.", "content": content, "headers": tag},
        206: {"description": "The range of it.", "content": content, "headers": tag},
        304: {"description": "The file that the client has is this one."},
        **problems(404, 413, 416, 429, 500, 504),
    }


CONDITIONS: list[dict[str, Any]] = [
    {"name": name, "in": "header", "required": False, "description": text, "schema": {"type": "string"}}
    for name, text in (
        ("If-None-Match", "ETags of what the client has."),
        ("Range", "One range of bytes, such as bytes=0-1023."),
        ("If-Range", "ETag of what the range continues."),
    )
]


def query_parameter(name: str, description: str, schema: Mapping[str, Any]) -> dict[str, Any]:
    """Return the entry of a query parameter, which the route reads by itself."""
    return {
        "name": name,
        "in": "query",
        "required": False,
        "description": description,
        "schema": dict(schema),
    }


def _reads(model: type[BaseModel], examples: Mapping[str, Any], toml: str | None = None) -> Extra:
    named = {name: {"summary": name, "value": value} for name, value in examples.items()}
    schema = {"$ref": _REF.format(model=model.__name__)}
    content: dict[str, Any] = {"application/json": {"schema": schema, "examples": named}}
    as_toml: dict[str, Any] = {"schema": {"type": "string"}}
    if toml is not None:
        as_toml["examples"] = {"in TOML": {"summary": "in TOML", "value": toml}}
    content["application/toml"] = as_toml
    return {"requestBody": {"required": True, "content": content}}


READS_SPEC = _reads(Spec, SPECS, SPEC_IN_TOML)
READS_SWEEP = _reads(Sweep, SWEEPS)


def use_openapi(app: FastAPI) -> None:
    """Let an app describe itself with the schemas of its bodies, at the first request for it."""

    def openapi() -> dict[str, Any]:
        if app.openapi_schema is None:
            app.openapi_schema = _openapi(app)
        return app.openapi_schema

    app.openapi = openapi  # type: ignore[method-assign]


def _openapi(app: FastAPI) -> dict[str, Any]:
    schema = get_openapi(title=app.title, version=app.version, description=app.description, routes=app.routes)
    components = schema.setdefault("components", {}).setdefault("schemas", {})
    for model in (Spec, ProblemAnswer):
        components.update(_components(model))
    components["Sweep"] = _sweep()
    for unused in ("HTTPValidationError", "ValidationError"):
        components.pop(unused, None)
    schema["components"]["securitySchemes"] = {"key": {"type": "http", "scheme": "bearer"}}
    return schema


def _components(model: type[BaseModel]) -> dict[str, Any]:
    schema = model.model_json_schema(ref_template=_REF)
    parts = schema.pop("$defs", {})
    return {name: with_bounds(part) for name, part in {**parts, model.__name__: schema}.items()}


def _sweep() -> dict[str, Any]:
    axis = {"anyOf": [{"type": "array", "minItems": 1}, {"$ref": _REF.format(model="Range")}]}
    return {
        "title": "Sweep",
        "description": "A base, and what varies: the product of all axes.",
        "type": "object",
        "additionalProperties": False,
        "required": ["base"],
        "properties": {
            "base": {
                "description": "Name of a preset, or a spec.",
                "anyOf": [
                    {"type": "string", "enum": list(preset_names())},
                    {"$ref": _REF.format(model="Spec")},
                ],
            },
            "formats": {"type": "array", "items": {"type": "string", "enum": [*map(str, FormatName)]}},
            "vary": {
                "description": "Values by the dotted path of a field of the spec.",
                "type": "object",
                "additionalProperties": axis,
            },
        },
    }
