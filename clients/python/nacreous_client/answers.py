"""What a service answers, as values."""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from nacreous_client.errors import AnswerError

__all__ = ["Failure", "Job", "JobTable", "Material", "Optics", "Preset", "Table", "parsed"]

T = TypeVar("T")
Document = Mapping[str, Any]

_PRESET_LABELS = ("title", "description", "source", "quantity")
_FINAL = frozenset({"done", "failed", "cancelled"})


@dataclass(frozen=True)
class Table:
    """A table that the service has.

    Parameters
    ----------
    id : str
        SHA-256, in hex, over everything that decides its values.
    certificate : mapping
        The errors of the table, as its files state them.
    links : mapping of str to str
        Path of each file by the name of its format, and ``"self"``.
    spec : mapping
        What it is of; empty in the answer to a spec.
    """

    id: str
    certificate: Document
    links: Mapping[str, str]
    spec: Document

    @classmethod
    def of(cls, document: Document) -> "Table":
        """Return the table of an answer."""
        spec = document.get("spec", {})
        return cls(_text(document["id"]), dict(document["certificate"]), _links(document), dict(spec))


@dataclass(frozen=True)
class Preset:
    """A spec that the service has by name.

    Parameters
    ----------
    name, title, description, source, quantity : str
    links : mapping of str to str
        Path of each file by the name of its format, and ``"self"``.
    id : str
        Of its table; empty in a list.
    spec : mapping
        Empty in a list.
    """

    name: str
    title: str
    description: str
    source: str
    quantity: str
    links: Mapping[str, str]
    id: str
    spec: Document

    @classmethod
    def of(cls, document: Document) -> "Preset":
        """Return the preset of an answer."""
        labels = {key: str(document.get(key, "")) for key in _PRESET_LABELS}
        spec = dict(document.get("spec", {}))
        return cls(
            _text(document["name"]), **labels, links=_links(document), id=document.get("id", ""), spec=spec
        )


@dataclass(frozen=True)
class Optics:
    """The index n + ik of a material at some wavelengths."""

    wavelength_nm: tuple[float, ...]
    n: tuple[float, ...]
    k: tuple[float, ...]


@dataclass(frozen=True)
class Material:
    """A named material.

    Parameters
    ----------
    name, description, citation : str
    range_nm : pair of float
        The wavelengths at which it can be used.
    optics : Optics, optional
        Not in a list.
    """

    name: str
    description: str
    citation: str
    range_nm: tuple[float, float]
    optics: Optics | None

    @classmethod
    def of(cls, document: Document) -> "Material":
        """Return the material of an answer."""
        first, last = document["range_nm"]
        return cls(
            name=_text(document["name"]),
            description=str(document.get("description", "")),
            citation=str(document.get("citation", "")),
            range_nm=(float(first), float(last)),
            optics=_optics(document),
        )


def _optics(document: Document) -> Optics | None:
    samples = document.get("samples")
    if samples is None:
        return None
    return Optics(*(tuple(map(float, samples[key])) for key in ("wavelength_nm", "n", "k")))


@dataclass(frozen=True)
class Failure:
    """A spec of a sweep, by its place in it, that has no table, and why."""

    spec: int
    message: str


@dataclass(frozen=True)
class JobTable:
    """A table of a job: the paths of its files by format, and the index of its spec in the sweep."""

    id: str
    links: Mapping[str, str]
    spec: int


@dataclass(frozen=True)
class Job:
    """A sweep on its way.

    Parameters
    ----------
    id : str
        SHA-256, in hex, of the sweep.
    state : str
        ``"queued"``, ``"running"``, ``"done"``, ``"failed"`` or ``"cancelled"``.
    done, failed, total : int
        Tables that are there, that could not be made, and in all.
    fraction : float
        How much is done, 0 to 1, the table that is being computed included.
    failures : tuple of Failure
        The first few.
    error : str
        Why the job as a whole has failed.
    created : str
        ISO 8601.
    formats : tuple of str
    tables : tuple of JobTable
        Those in the answer; none in a report of progress.
    """

    id: str
    state: str
    done: int
    failed: int
    total: int
    fraction: float
    failures: tuple[Failure, ...]
    error: str
    created: str
    formats: tuple[str, ...]
    tables: tuple[JobTable, ...]

    @property
    def finished(self) -> bool:
        """Whether nothing more will happen to it."""
        return self.state in _FINAL

    @classmethod
    def of(cls, document: Document) -> "Job":
        """Return the job of an answer."""
        return cls(
            id=_text(document["id"]),
            state=_text(document["state"]),
            done=int(document["done"]),
            failed=int(document.get("failed", 0)),
            total=int(document["total"]),
            fraction=float(document.get("fraction", 0)),
            failures=tuple(
                Failure(int(each["spec"]), str(each["message"])) for each in document.get("failures", ())
            ),
            error=str(document.get("error", "")),
            created=str(document.get("created", "")),
            formats=tuple(map(str, document.get("formats", ()))),
            tables=tuple(
                JobTable(each["id"], _links(each), int(each["spec"])) for each in document.get("tables", ())
            ),
        )


def _links(document: Document) -> dict[str, str]:
    return {str(name): _path(link) for name, link in document.get("links", {}).items()}


def _path(value: object) -> str:
    """Return a path of the service; no other host is ever asked."""
    if not _text(value).startswith("/"):
        raise ValueError
    return _text(value)


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise TypeError
    return value


def parsed(body: bytes, read: Callable[[Any], T]) -> T:
    """Return what `read` makes of a JSON document; raises `AnswerError` where it is not as it should be."""
    try:
        return read(json.loads(body))
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        shown = body[:60].decode("utf-8", "replace")
        message = f"expected an answer of a Nacreous service, got {shown!r}: is it one?"
        raise AnswerError(message) from None
