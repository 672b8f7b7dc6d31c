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
    title: str = Field(description="The phrase of the status.")
    status: int = Field(description="The status of the answer.")
    detail: str = Field(description="One message for a person.")
    field: str | None = Field(None, description="Dotted path of the field that is wrong.")
    expected: str | None = Field(None, description="What may stand there.")
    got: str | None = Field(None, description="What came, shortened.")
    remedy: str | None = Field(None, description="What to do instead, where that is known.")


class TableAdded(_Answer):
    """A spec that has been tabulated."""

    id: str = Field(description="64 hex digits: a hash over everything that decides the values.")
    created: bool = Field(description="Whether it was unknown before.")
    certificate: Certificate = Field(description="The errors measured of the table.")
    links: Links = Field(description="The table itself, and its file in every format that can hold it.")


class TableAnswer(_Answer):
    """What is known of a table."""

    id: str = Field(description="64 hex digits: a hash over everything that decides the values.")
    spec: dict[str, Any] = Field(description="The spec, complete but for its labels.")
    certificate: Certificate = Field(description="The errors measured of the table.")
    links: Links = Field(description="The table itself, and its file in every format that can hold it.")


class TableLinks(_Answer):
    """A finished table of a job."""

    id: str = Field(description="The id of the table.")
    links: Links = Field(description="The table itself, and its files of the job's formats.")


class FailureAnswer(_Answer):
    """A table of a job that could not be made."""

    spec: int = Field(description="Its index in the sweep.")
    message: str = Field(description="Why it could not be made.")


class JobProgress(_Answer):
    """How far a job is."""

    id: str = Field(description="64 hex digits: a hash over the sweep.")
    state: str = Field(description="queued, running, done, failed or cancelled.")
    done: int = Field(description="Tables that are finished.")
    failed: int = Field(description="Tables that could not be made.")
    total: int = Field(description="Tables of the sweep.")
    fraction: float = Field(description="How much is done, 0 to 1, of the table in hand as well.")
    failures: list[FailureAnswer] = Field(description="Why, of the first few that could not be made.")
    created: str = Field(description="When it was sent, in UTC as ISO 8601 has it.")
    formats: list[str] = Field(description="The formats of every table.")
    error: str | None = Field(None, description="Why the job as a whole has ended, where it has failed.")
    links: Links = Field(description="The job itself, and its events.")


class JobTable(_Answer):
    """A finished table of a job."""

    spec: int = Field(
        description="Its index in the sweep: the last of the paths, in their order, varies fastest."
    )
    id: str = Field(description="The id of the table.")
    links: Links = Field(description="The table itself, and its files of the job's formats.")


class JobAnswer(JobProgress):
    """A job and its finished tables, one page of them."""

    tables: list[JobTable] = Field(description="The finished tables, in the order of the sweep.")


class JobAccepted(_Answer):
    """A spec that takes too long to wait for: a job computes it."""

    job: JobAnswer = Field(description="The job.")
    links: Links = Field(description="Where the job is, and where the table will be.")


class PresetEntry(_Answer):
    """A preset, and where its numbers come from."""

    name: str = Field(description="The name of the preset.")
    title: str = Field(description="What it is.")
    description: str = Field(description="What it shows.")
    source: str = Field(description="Whose numbers it has.")
    quantity: str = Field(description="fresnel, albedo or bsdf.")
    links: Links = Field(description="The preset itself, and its file in every format that can hold it.")


class PresetList(RootModel[list[PresetEntry]]):
    """All presets; a bare list, as the Blender add-on reads it."""


class PresetAnswer(PresetEntry):
    """A preset with its spec."""

    id: str = Field(description="The id of its table.")
    spec: dict[str, Any] = Field(description="The spec, complete but for its labels.")


class MaterialEntry(_Answer):
    """A named material, and whose numbers it has."""

    name: str = Field(description="The name by which a spec may call it.")
    description: str = Field(description="What a user should know about it.")
    citation: str = Field(description="Whose numbers these are.")
    range_nm: tuple[float, float] = Field(description="First and last vacuum wavelength of its data.")


class MaterialList(_Answer):
    """One page of the materials that were searched for."""

    materials: list[MaterialEntry] = Field(description="The materials of this page.")
    total: int = Field(description="How many were found in all.")


class Samples(_Answer):
    """Its refractive index n + ik over the vacuum wavelength."""

    wavelength_nm: list[float] = Field(description="Vacuum wavelengths, ascending.")
    n: list[float] = Field(description="Refractive index at each.")
    k: list[float] = Field(description="Extinction coefficient at each.")


class MaterialAnswer(MaterialEntry):
    """A material with samples of it."""

    samples: Samples = Field(description="Its n and k over the wavelengths.")


class Health(_Answer):
    """The process answers."""

    status: str = Field(description="ok.")
    version: str = Field(description="The version of Nacreous.")


class Readiness(_Answer):
    """Tables are computed."""

    ready: bool = Field(description="Whether tables are computed.")
    engine: str = Field(description="What the engine does.")
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
