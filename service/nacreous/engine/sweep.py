"""A sweep: a base and what varies; the tables of a job, or of a batch.

    base = "soap-bubble"
    formats = ["exr"]
    [vary]
    "stack.layers.0.thickness_nm" = { start = 100, stop = 800, count = 200 }

The tables are the product of all axes in the order of their sorted paths, the last of them the fastest.
"""

import hashlib
import json
import math
from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import pairwise
from typing import Annotated, Any, Self

import numpy as np
from pydantic import AfterValidator, Field, Tag, ValidationError, model_validator

from nacreous.engine.files import default_format
from nacreous.engine.work import Work
from nacreous.errors import SpecError
from nacreous.formats.names import FormatName
from nacreous.formats.registry import find_format
from nacreous.optics.value import AsTuple, StrictModel, form_tag, refusal, shown
from nacreous.tables.axes import MAX_POINTS, Range, one_of, range_values
from nacreous.tables.presets import preset
from nacreous.tables.spec import LABELS, Spec
from nacreous.tables.spec_document import Document, assigned, spec_error

__all__ = ["MAX_TABLES", "Sweep"]

MAX_TABLES = 10_000
"""Tables of a sweep, where its reader sets no other limit."""
_MOST_AXES = 16
_TRIED = 200
"""Values of an axis that are tried before anything is computed: the ends, and others evenly between."""

_LIST, _RANGE, _NAME, _SPEC = map(form_tag, ("list", "range", "name", "spec"))


def _axis_form(value: object) -> str | None:
    if isinstance(value, list | tuple):
        return _LIST
    return _RANGE if isinstance(value, dict | Range) else None


def _base_form(value: object) -> str | None:
    if isinstance(value, str):
        return _NAME
    return _SPEC if isinstance(value, dict) else None


def _check_format(name: str) -> str:
    try:
        return find_format(name).name.value
    except SpecError as error:
        raise refusal(error.expected, error.got, error.remedy) from None


_Values = Annotated[tuple[Any, ...], Field(min_length=1, max_length=MAX_POINTS), AsTuple]
_Axis = Annotated[
    Annotated[_Values, Tag(_LIST)] | Annotated[Range, Tag(_RANGE)],
    one_of(_axis_form, "a list, { start, stop, step } or { start, stop, count }"),
]
_Base = Annotated[
    Annotated[str, Tag(_NAME)] | Annotated[dict[str, Any], Tag(_SPEC)],
    one_of(_base_form, "the name of a preset, or a spec"),
]
_Format = Annotated[str, AfterValidator(_check_format)]


class Sweep(StrictModel):
    """The product of all axes over a base.

    Parameters
    ----------
    base : str or mapping
        Name of a preset, or a spec's document. No file: whoever may read files puts a document here.
    formats : sequence of str
        Names of formats; without any, the default format of each table.
    vary : mapping of str to list or Range
        Values by the dotted path of the field that takes them.
    """

    base: _Base
    formats: Annotated[tuple[_Format, ...], Field(max_length=len(FormatName)), AsTuple] = ()
    vary: Annotated[dict[str, _Axis], Field(max_length=_MOST_AXES)] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _check_paths(self) -> Self:
        """Refuse paths that set the same field, so that their order cannot matter."""
        paths = sorted(map(_parts, self.vary))
        for one, other in pairwise(paths):  # a prefix sorts right before what it begins
            if other[: len(one)] == one:
                outer, inner = ".".join(one), ".".join(other)
                raise refusal("paths to different fields", f"{shown(outer)} and {shown(inner)}", field="vary")
        return self

    @classmethod
    def from_document(cls, document: Document, limit: int = MAX_TABLES) -> Self:
        """Return the sweep of a parsed document, of at most `limit` tables; raises `SpecError`.

        Values of each axis are tried with the first of all others, so that most mistakes show here; it takes
        about a millisecond a value.
        """
        try:
            sweep = cls.model_validate(document)
        except ValidationError as error:
            raise spec_error(error) from None
        if len(sweep) > limit:
            remedy = "vary fewer values, or make several sweeps"
            raise SpecError("vary", f"at most {limit:,} tables", f"{len(sweep):,}", remedy)
        sweep._try_values()
        return sweep

    @classmethod
    def of(cls, spec: Spec, formats: Sequence[str] = ()) -> Self:
        """Return the sweep of one spec alone."""
        return cls(base=spec.model_dump(mode="json", exclude=set(LABELS)), formats=tuple(formats))

    def to_document(self) -> Document:
        """Return the document that `from_document` reads."""
        return self.model_dump(mode="json", exclude_none=True)

    @cached_property
    def id(self) -> str:
        """SHA-256, in hex, over all that decides the files: the first table, the axes and the formats."""
        axes = {path: list(values) for path, values in self._axes.items()}
        decisive = {"first": self[0][0].id, "axes": axes, "formats": sorted(set(self.formats))}
        # 100 and 100.0 are the same value, in whatever material or axis they lie.
        alike = json.loads(json.dumps(decisive, default=str), parse_int=float)
        return hashlib.sha256(json.dumps(alike, sort_keys=True).encode()).hexdigest()

    def __len__(self) -> int:
        return math.prod(len(values) for values in self._axes.values())

    def __getitem__(self, index: int) -> tuple[Work, ...]:
        """Return the works of a table, one a format; raises `SpecError` where its spec is wrong."""
        if not 0 <= index < len(self):
            raise IndexError(index)
        shape = tuple(len(values) for values in self._axes.values())
        places = np.unravel_index(index, shape) if shape else ()
        return self._works(dict(zip(self._axes, map(int, places), strict=True)))

    @cached_property
    def _axes(self) -> Mapping[str, tuple[Any, ...]]:
        """Values by path, in the order of the paths."""
        by_path = {".".join(_parts(path)): _values(axis) for path, axis in self.vary.items()}
        return dict(sorted(by_path.items()))

    @cached_property
    def _document(self) -> Document:
        """What the values are put in; raises `SpecError` where there is no such preset."""
        if not isinstance(self.base, str):
            return self.base
        try:
            spec = preset(self.base)
        except SpecError as error:
            raise error.under("base") from None
        return spec.model_dump(mode="json")

    def _works(self, places: Mapping[str, int]) -> tuple[Work, ...]:
        document = self._document
        for path, place in places.items():
            document = assigned(document, path, self._axes[path][place])
        spec = Spec.from_document(document)
        formats = tuple(FormatName(name) for name in dict.fromkeys(self.formats))
        return tuple(Work(spec, chosen) for chosen in formats or (default_format(spec),))

    def _try_values(self) -> None:
        first = dict.fromkeys(self._axes, 0)
        self._try(first, "")
        for path, values in self._axes.items():
            for place in np.unique(np.linspace(0, len(values) - 1, _TRIED).round()):
                self._try({**first, path: int(place)}, path)

    def _try(self, places: Mapping[str, int], path: str) -> None:
        """Make the works of one table; raises `SpecError` with the field of the sweep that is wrong."""
        try:
            self._works(places)
        except SpecError as error:
            raise self._in_sweep(error, path) from None

    def _in_sweep(self, error: SpecError, path: str) -> SpecError:
        """Return the error of a table as one of the sweep: that the value at `path` is wrong, if it is."""
        field = error.field
        if field == "base":
            return error
        if field == "format":
            return SpecError("formats", error.expected, error.got, error.remedy)
        if not field or any(_leads_to(varied, field) or _leads_to(field, varied) for varied in self._axes):
            return error.under("vary")
        if not path:
            return error.under("base")
        return SpecError(
            f"vary.{path}", f"values with which {field} is {error.expected}", error.got, error.remedy
        )


def _parts(path: str) -> tuple[str, ...]:
    """Return the parts of a dotted path; "00" is the position 0, too."""
    parts = (part.strip() for part in path.split("."))
    return tuple(str(int(part)) if part.isdecimal() and len(part) < 6 else part for part in parts)


def _values(axis: Range | tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the values of an axis; a whole one as an integer, which may stand for a real number."""
    if isinstance(axis, tuple):
        return axis
    return tuple(int(value) if value.is_integer() else value for value in range_values(axis).tolist())


def _leads_to(outer: str, inner: str) -> bool:
    return bool(outer) and (inner == outer or inner.startswith(f"{outer}."))
