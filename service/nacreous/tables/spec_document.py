"""Reading a spec's document: TOML or JSON from anyone, and what may be wrong with it.

Whatever comes in, one `SpecError` goes out at the worst, and soon: size and nesting are bounded
before a parser sees them.
"""

import json
import math
import re
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping
from enum import StrEnum
from pathlib import Path
from types import MappingProxyType
from typing import Any

from pydantic import ValidationError

from nacreous.errors import SpecError, reason
from nacreous.optics.value import REFUSED, is_form_tag, named, shown

__all__ = ["MAX_BYTES", "Document", "Syntax", "assigned", "override", "parse", "read", "spec_error"]

Document = dict[str, Any]

MAX_BYTES = 2 * 2**20
MAX_DEPTH = 32
"""Levels of tables and lists, and parts of a dotted key; the deepest spec of the schema has about twenty."""


class Syntax(StrEnum):
    """How a document is written."""

    TOML = "toml"
    JSON = "json"


def read(path: Path) -> Document:
    """Return the document in a file: JSON where its name ends so, else TOML; raises `SpecError`."""
    try:
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:  # ValueError: a NUL character in the name
        raise SpecError("", "a spec file that can be read", f"{shown(str(path))}: {reason(error)}") from None
    return parse(data, Syntax.JSON if path.suffix.lower() == ".json" else Syntax.TOML)


def parse(document: str | bytes, syntax: Syntax) -> Document:
    """Return the top-level table of a TOML or JSON document.

    Raises
    ------
    SpecError
        The document is empty, over 2 MiB, not UTF-8, nested deeper than 32 levels, not of this syntax, no
        table, or holds a key twice or a number that is not finite.
    """
    text = _text(document)
    _check_nesting(text)
    try:
        parsed = _PARSERS[syntax](text)
        _check_characters(parsed)
    except (ValueError, RecursionError) as error:
        raise SpecError("", f"a {syntax.upper()} document", _reason(error)) from None
    if not isinstance(parsed, dict):
        raise SpecError("", "a table at the top level", shown(parsed))
    return parsed


def _text(document: str | bytes) -> str:
    size = len(document) if isinstance(document, bytes) else len(document.encode("utf-8", "surrogatepass"))
    if size > MAX_BYTES:
        raise SpecError("", f"a document of at most {MAX_BYTES // 2**20} MiB", "a larger one")
    try:
        text = document.decode("utf-8-sig") if isinstance(document, bytes) else document
    except UnicodeDecodeError as error:
        raise SpecError(
            "", "a document in UTF-8", f"byte {error.object[error.start]:#04x} at {error.start}"
        ) from None
    if not text.strip():
        raise SpecError("", "a spec", "an empty document", "`nacreous presets` lists specs to begin with")
    return text


_TOKENS = re.compile(
    # Strings and comments, whose contents do not count. A string that never ends reaches to the end of its
    # line or of the document, once and for all: the possessive repeats keep this pass linear.
    r'"""(?:\\.|(?!""")[^\\])*+(?:""")?|"(?:\\[^\n]|[^"\\\n])*+"?'
    r"|'''(?:(?!''').)*+(?:''')?|'[^'\n]*+'?|#[^\n]*+"
    r"|[\[\]{}.=,\n]",
    re.DOTALL,
)


def _check_nesting(text: str) -> None:
    """Refuse a document nested so deeply that its parser would exhaust the stack, or the patience."""
    depth = dots = 0
    for token in _TOKENS.finditer(text):
        mark = token.group()
        depth += (mark in "[{") - (mark in "]}")
        dots = dots + 1 if mark == "." else 0 if mark in "=,\n" else dots
        if max(depth, dots) > MAX_DEPTH:
            line = text.count("\n", 0, token.start()) + 1
            raise SpecError("", f"at most {MAX_DEPTH} levels of nesting", f"more in line {line}")


_SURROGATE = re.compile("[\ud800-\udfff]")
"""Half of a pair, which JSON can escape and no text can hold."""


class _Fault(ValueError):  # noqa: N818 - json passes it on, and `parse` makes a SpecError of it
    """What a table of the document must not hold, in words fit to be shown."""


class _NotFinite(str):
    """NaN, Infinity, or a number beyond double precision, as the document has it."""

    __slots__ = ()


def _parse_json(text: str) -> object:
    return json.loads(
        text, object_pairs_hook=_checked_table, parse_constant=_NotFinite, parse_float=_finite_or_not
    )


def _checked_table(pairs: list[tuple[str, Any]]) -> Document:
    """Refuse what no table may hold, here where its key is known."""
    table: Document = {}
    for key, value in pairs:
        if key in table:
            raise _Fault(f"the key {shown(key)} twice")
        table[key] = value
        fault = next(filter(None, map(_fault, (key, *_parts(value)))), None)
        if fault:
            raise _Fault(f"{fault} at the key {shown(key)}")
    return table


def _fault(part: object) -> str:
    """Return what is wrong with a key, or with a value that is no table; nothing for a good one."""
    if isinstance(part, _NotFinite):
        return f"{shown(str(part))[1:-1]}, not a finite number,"
    return "half of a surrogate pair" if isinstance(part, str) and _SURROGATE.search(part) else ""


def _parts(value: object) -> Iterator[object]:
    """Yield a value, or what a list of lists holds; the tables in it have been looked at."""
    if isinstance(value, list):
        for entry in value:
            yield from _parts(entry)
    else:
        yield value


def _finite_or_not(literal: str) -> float | _NotFinite:
    value = float(literal)
    return value if math.isfinite(value) else _NotFinite(literal)


_PARSERS: Mapping[Syntax, Callable[[str], object]] = MappingProxyType(
    {Syntax.TOML: tomllib.loads, Syntax.JSON: _parse_json}
)


def _check_characters(parsed: object) -> None:
    """Refuse half a surrogate pair, which a Python text can hold and no document can."""
    json.dumps(parsed, ensure_ascii=False, default=str).encode("utf-8")


def _reason(error: Exception) -> str:
    if isinstance(error, _Fault):
        return str(error)
    if isinstance(error, UnicodeEncodeError):
        return "half of a surrogate pair"
    if isinstance(error, RecursionError):
        return "one nested too deeply"
    return named(str(error))


# ---- overrides ---------------------------------------------------------------------------------------------


def override(document: Document, assignments: Iterable[str]) -> Document:
    """Return `document` with each ``table.cos_theta=256`` of `assignments` carried out, in order.

    A path's parts are names of fields and positions in lists; a section that is not there is made. The value
    is read as TOML, and where it is not TOML, as text: ``colour.space=ACEScg`` needs no quotes.

    Raises
    ------
    SpecError
        An assignment has no ``=``, or its path leads through something that has no such part.
    """
    for assignment in assignments:
        path, equals, value = assignment.partition("=")
        if not equals or not _is_path(path):
            got = shown(assignment)
            raise SpecError("--set", "FIELD=VALUE", got, "for example --set table.cos_theta=256")
        document = assigned(document, path.strip(), _value(value.strip()))
    return document


def assigned(document: Document, path: str, value: object) -> Document:
    """Return `document` with a value at a dotted path such as ``"stack.layers.0.thickness_nm"``.

    Raises
    ------
    SpecError
        It is no path, or it leads through something that has no such part.
    """
    if not _is_path(path):
        expected = f"the path of a field, of at most {MAX_DEPTH} parts"
        raise SpecError("", expected, shown(path), 'for example "stack.layers.0.thickness_nm"')
    parts = [part.strip() for part in path.split(".")]
    return _assigned(document, parts, value, path)  # type: ignore[no-any-return]


def _is_path(path: str) -> bool:
    parts = path.split(".")
    return all(part.strip() for part in parts) and len(parts) <= MAX_DEPTH


def _value(text: str) -> object:
    try:
        parsed = parse(f"value = {text}\n", Syntax.TOML)
    except SpecError:
        return text
    return parsed["value"] if parsed.keys() == {"value"} else text


def _assigned(parent: Any, parts: list[str], value: object, path: str) -> Any:  # noqa: ANN401 - any document
    """Return a copy of `parent` in which the part at `parts` is `value`."""
    part, *rest = parts
    if isinstance(parent, dict):
        child = parent.get(part, {}) if rest else None
        return {**parent, part: _assigned(child, rest, value, path) if rest else value}
    if isinstance(parent, list) and part.isdecimal() and len(part) < 6 and int(part) < len(parent):
        position = int(part)
        child = _assigned(parent[position], rest, value, path) if rest else value
        return [*parent[:position], child, *parent[position + 1 :]]
    where = f"a position from 0 to {len(parent) - 1}" if isinstance(parent, list) else "a table with fields"
    raise SpecError(path, where, f"{shown(part)} in {shown(parent)}", "set the value above it as a whole")


# ---- what pydantic found ----------------------------------------------------------------------------------

_EXPECTED: Mapping[str, str] = MappingProxyType(
    {
        "bool_type": "true or false",
        "dict_type": "a table",
        "finite_number": "a finite number",
        "float_type": "a number",
        "greater_than": "a number > {gt}",
        "greater_than_equal": "a number >= {ge}",
        "int_type": "a whole number",
        "less_than": "a number < {lt}",
        "less_than_equal": "a number <= {le}",
        "literal_error": "{expected}",
        "missing": "a value",
        "model_type": "a table",
        "string_too_long": "text of at most {max_length} characters",
        "string_too_short": "text of at least {min_length} characters",
        "string_type": "text",
        "string_unicode": "text",
        "too_long": "a list of at most {max_length} values",
        "too_short": "a list of at least {min_length} values",
        "tuple_type": "a list",
    }
)
"""What a value should have been, by pydantic's type of the error; its context fills the braces."""


def spec_error(error: ValidationError) -> SpecError:
    """Return the first thing that pydantic found, as the one message that a person reads."""
    first, *others = error.errors(include_url=False)
    kind, context = first["type"], first.get("ctx", {})
    path = [named(str(part)) for part in first["loc"] if not is_form_tag(part)]
    if context.get("field") and kind == REFUSED:
        path.append(named(context["field"]))
    got = "nothing" if kind == "missing" else shown(first["input"])
    return SpecError(
        field=".".join(path),
        expected=context["expected"] if kind == REFUSED else _expected(kind, first["msg"], context),
        got=context.get("got", got) + (f" (and {len(others)} more)" if others else ""),
        remedy=context.get("remedy", ""),
    )


def _expected(kind: str, message: str, context: Mapping[str, Any]) -> str:
    if kind in _EXPECTED:
        return _EXPECTED[kind].format(**context)
    return message.removeprefix("Input should be ")
