"""The JSON documents of the service, each written once: what is answered, and its schema in OpenAPI."""

import hashlib
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, RootModel
from starlette.responses import Response
from starlette.types import Scope

from nacreous.web.caching import REVALIDATE, FileResponse, Representation, compressed

__all__ = [
    "FailureAnswer",
    "Health",
    "JobAccepted",
    "JobAnswer",
    "JobProgress",
    "MaterialAnswer",
    "MaterialEntry",
    "MaterialList",
    "PresetAnswer",
    "PresetEntry",
    "PresetList",
    "ProblemAnswer",
    "Readiness",
    "Samples",
    "TableAdded",
    "TableAnswer",
    "TableLinks",
    "document",
    "json_response",
]

JSON = "application/json"
_WORTH_COMPRESSING = 1024
"""Bytes below which gzip saves less than its header costs."""

Links = dict[str, str]
Certificate = dict[str, Any]


class _Answer(BaseModel):
    """An answer: what has no value is left out."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class ProblemAnswer(_Answer):
    """What is wrong, as RFC 9457 has it."""

    type: str = Field(description="urn:nacreous:problem: and a word.")
    title: str
    status: int
    detail: str
    field: str | None = Field(None, description="Dotted path of the field that is wrong.")
    expected: str | None = None
    got: str | None = None
    remedy: str | None = None


class TableAdded(_Answer):
    """A spec that has been tabulated."""

    id: str
    created: bool = Field(description="Whether it was unknown before.")
    certificate: Certificate = Field(description="The errors measured of the table.")
    links: Links = Field(description="The table itself, and its file in every format that can hold it.")


class TableAnswer(_Answer):
    """What is known of a table."""

    id: str
    spec: dict[str, Any]
    certificate: Certificate
    links: Links


class TableLinks(_Answer):
    """A finished table of a job."""

    id: str
    links: Links


class FailureAnswer(_Answer):
    """A table of a job that could not be made."""

    spec: int = Field(description="Its index in the sweep.")
    message: str


class JobProgress(_Answer):
    """How far a job is."""

    id: str
    state: str = Field(description="queued, running, done, failed or cancelled.")
    done: int
    failed: int
    total: int
    fraction: float
    failures: list[FailureAnswer]
    created: str
    formats: list[str]
    error: str | None = None
    links: Links


class JobTable(_Answer):
    """A finished table of a job."""

    spec: int = Field(
        description="Its index in the sweep: the last of the paths, in their order, varies fastest."
    )
    id: str
    links: Links


class JobAnswer(JobProgress):
    """A job and its finished tables, one page of them."""

    tables: list[JobTable]


class JobAccepted(_Answer):
    """A spec that takes too long to wait for: a job computes it."""

    job: JobAnswer
    links: Links


class PresetEntry(_Answer):
    """A preset, and where its numbers come from."""

    name: str
    title: str
    description: str
    source: str
    quantity: str
    links: Links


class PresetList(RootModel[list[PresetEntry]]):
    """All presets; a bare list, as the Blender add-on reads it."""


class PresetAnswer(PresetEntry):
    """A preset with its spec."""

    id: str
    spec: dict[str, Any]


class MaterialEntry(_Answer):
    """A named material, and whose numbers it has."""

    name: str
    description: str
    citation: str
    range_nm: tuple[float, float]


class MaterialList(_Answer):
    """One page of the materials that were searched for."""

    materials: list[MaterialEntry]
    total: int


class Samples(_Answer):
    """Its refractive index n + ik over the vacuum wavelength."""

    wavelength_nm: list[float]
    n: list[float]
    k: list[float]


class MaterialAnswer(MaterialEntry):
    """A material with samples of it."""

    samples: Samples


class Health(_Answer):
    """The process answers."""

    status: str
    version: str


class Readiness(_Answer):
    """Tables are computed."""

    ready: bool
    engine: str
    store: str = Field(description='"writable", or why it is not: tables are then answered without it.')


def document(answer: BaseModel) -> bytes:
    """Return the JSON of an answer, without what it has not."""
    return answer.model_dump_json(exclude_none=True).encode()


def json_response(answer: BaseModel, scope: Scope, cache_control: bytes = REVALIDATE) -> Response:
    """Return what answers a GET: with an ETag of its own, and compressed where that helps."""
    return json_file(document(answer), scope, cache_control)


def json_file(payload: bytes, scope: Scope, cache_control: bytes = REVALIDATE) -> Response:
    """Return what answers a GET with a finished JSON document."""
    tag = hashlib.sha256(payload).hexdigest()
    file = Representation(payload, tag, JSON, cache_control)
    return FileResponse(file if len(payload) < _WORTH_COMPRESSING else compressed(file, scope))
