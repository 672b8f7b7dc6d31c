"""What every value of a spec has in common: strict, frozen, finite, and refused in the same words.

A spec arrives as TOML, JSON or Python; `StrictModel` reads all three alike. An integer may stand for a real
number, a list for a sequence; nothing else is converted, so ``true`` and ``"5"`` are no numbers.
"""

import difflib
from collections.abc import Iterable
from typing import Annotated, Any, Literal, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    GetJsonSchemaHandler,
    ValidatorFunctionWrapHandler,
    model_validator,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError

__all__ = [
    "REFUSED",
    "AsTuple",
    "Extrapolation",
    "Number",
    "StrictModel",
    "did_you_mean",
    "form_tag",
    "is_form_tag",
    "named",
    "refusal",
    "shown",
]

REFUSED: Literal["nacreous_refused"] = "nacreous_refused"
"""The pydantic error type of `refusal`; its context holds `field`, `expected`, `got` and `remedy`."""

Extrapolation = Literal["refuse", "hold"]
"""Beyond a material's data: refuse the wavelength, or hold the value at the nearer end."""

_FORM = "form:"
_SHOWN_CHARACTERS = 60


def refusal(expected: str, got: str, remedy: str = "", *, field: str = "") -> PydanticCustomError:
    """Return the error that a validator raises: `field` lies below the value it validates, if it is named."""
    context = {"field": field, "expected": expected, "got": got, "remedy": remedy}
    return PydanticCustomError(REFUSED, "expected {expected}, got {got}", context)


def shown(value: object) -> str:
    """Return `value` as a message shows it: short, on one line, printable whatever it holds."""
    if isinstance(value, dict):
        value = f"a table of {', '.join(map(str, value)) or 'nothing'}"
    elif isinstance(value, list | tuple) and len(value) > 4:
        return f"a list of {len(value)} values"
    else:
        value = _literal(list(value) if isinstance(value, tuple) else value)
    return named(value)


def named(text: str) -> str:
    """Return a text without quotes of its own, such as a field's name, as a message shows it; see `shown`."""
    text = text if text.isprintable() else ascii(text)[1:-1]
    return text if len(text) <= _SHOWN_CHARACTERS else text[: _SHOWN_CHARACTERS - 1] + "…"


def _literal(value: object) -> str:
    """Write a value as TOML and JSON do."""
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int) and abs(value) >= 10**_SHOWN_CHARACTERS:  # str() refuses very long integers
        return "an integer of more than 60 digits"
    return f'"{value}"' if isinstance(value, str) else str(value)


def did_you_mean(name: str, known: Iterable[str], *, otherwise: str = "") -> str:
    """Return the remedy for an unknown name: the known names closest to it, or `otherwise`."""
    by_lower = {candidate.lower(): candidate for candidate in known}
    close = difflib.get_close_matches(name.lower()[:100], by_lower, n=3, cutoff=0.6)
    return f"did you mean {' or '.join(by_lower[match] for match in close)}?" if close else otherwise


def form_tag(form: str) -> str:
    """Return the tag of one form of a value; `SpecError` leaves tags out of a field's path."""
    return _FORM + form


def is_form_tag(part: object) -> bool:
    """Tell whether one part of a pydantic location names a form rather than a field."""
    return isinstance(part, str) and part.startswith(_FORM)


def _as_tuple(value: object) -> object:
    return tuple(value) if isinstance(value, list) else value


AsTuple = BeforeValidator(_as_tuple)
"""Lets a list stand for a tuple, TOML and JSON having no other sequence; the outermost annotation."""


def _unsigned_zero(value: float) -> float:
    return value + 0.0  # -0.0 and 0.0 are the same number: let them be the same bytes


Number = Annotated[float, Field(strict=True, allow_inf_nan=False), AfterValidator(_unsigned_zero)]
"""A finite real number, or an integer in its place; there is one zero."""


class StrictModel(BaseModel):
    """A frozen value: no unknown field, no conversion, no NaN or infinity."""

    model_config = ConfigDict(
        extra="forbid", frozen=True, strict=True, allow_inf_nan=False, hide_input_in_errors=True
    )

    @model_validator(mode="wrap")
    @classmethod
    def _name_unknown_fields(cls, value: Any, handler: ValidatorFunctionWrapHandler) -> Self:  # noqa: ANN401 - raw input
        """Refuse an unknown field with the field that was probably meant."""
        unknown = [key for key in value if key not in cls.model_fields] if isinstance(value, dict) else []
        if not unknown:
            return handler(value)  # type: ignore[no-any-return]
        known = ", ".join(cls.model_fields)
        remedy = did_you_mean(str(unknown[0]), cls.model_fields)
        field = str(unknown[0]).encode("utf-8", "backslashreplace").decode()
        raise refusal(f"one of the fields {known}", "an unknown field", remedy, field=field)

    @classmethod
    def __get_pydantic_json_schema__(
        cls, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Describe the value and its fields in the words of its docstring."""
        from nacreous.optics.documented import field_descriptions, summary

        reference = handler(schema)
        described = handler.resolve_ref_schema(reference)
        docstring = cls.__doc__ or ""
        described["description"] = summary(docstring)
        for name, text in field_descriptions(docstring).items():
            described["properties"][name]["description"] = text
        return reference
