"""Fields of a JSON Schema as entries of a page: type, unit, default, range and description."""

import json
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from docutils import nodes

from nacreous_site.entries import Inline, entry, facts, identifier, literal, paragraphs

__all__ = ["Schema", "field_entries", "field_facts", "references", "type_words", "unit_of"]

Schema = Mapping[str, Any]
Link = Callable[[str], nodes.Node]
"""From the name of a model to a link to its section."""

_NAMES = {
    "string": "text",
    "number": "number",
    "integer": "integer",
    "boolean": "true or false",
    "object": "table",
    "null": "nothing",
}
_UNITS = {"_nm": "nm", "_um2": "µm²", "_seconds": "s", "_bytes": "bytes"}
_RADIANS = ("theta_i", "theta_o", "phi", "phi_i")


def unit_of(name: str) -> str:
    """Return the unit of a field, which its name ends in; angles are in radians.

    >>> unit_of("thickness_nm"), unit_of("phi_i"), unit_of("cos_theta")
    ('nm', 'rad', '')
    """
    if name in _RADIANS:
        return "rad"
    return next((unit for suffix, unit in _UNITS.items() if name.endswith(suffix)), "")


def field_entries(schema: Schema, prefix: str, link: Link) -> Iterator[nodes.Element]:
    """Yield the entry of each field of an object; `prefix` is that of their ids."""
    required = schema.get("required", ())
    for name, field in schema.get("properties", {}).items():
        text = paragraphs(field.get("description", ""))
        note = "required" if name in required else ""
        yield entry(identifier(prefix, name), name, *text, *field_facts(name, field, link), note=note)


def field_facts(name: str, field: Schema, link: Link) -> list[nodes.Element]:
    """Return type, unit and default of a field."""
    unit = unit_of(name)
    return facts(
        {
            "Type": type_words(field, link),
            "Unit": [nodes.Text(unit)] if unit else [],
            "Default": _default(field),
        }
    )


def _default(field: Schema) -> Inline:
    """Return the default in JSON; a table of defaults is described where its own fields are."""
    default = field.get("default")
    if default in (None, "", []) or (isinstance(default, Mapping) and "$ref" in field):
        return []
    if isinstance(default, Mapping):
        default = {name: value for name, value in default.items() if value is not None}
    return [literal(json.dumps(default, ensure_ascii=False))]


def type_words(schema: Schema, link: Link) -> Inline:
    """Return in words what a value of a schema is, with its bounds; null, which leaves it out, is none."""
    forms = [form for form in _forms(schema) if form.get("type") != "null"]
    parts = [_form_words(form, link) for form in forms]
    return [node for part in _joined(parts, " or ") for node in part]


def _forms(schema: Schema) -> list[Schema]:
    return list(schema.get("anyOf") or schema.get("oneOf") or [schema])


def _joined(parts: list[Inline], by: str) -> Iterator[Inline]:
    for position, part in enumerate(parts):
        if position:
            yield [nodes.Text(by)]
        yield part


def _form_words(schema: Schema, link: Link) -> Inline:
    if "$ref" in schema:
        return [link(schema["$ref"].rpartition("/")[2])]
    if "anyOf" in schema or "oneOf" in schema:
        return type_words(schema, link)
    if "const" in schema or "enum" in schema:
        return _enumeration(schema.get("enum", [schema.get("const")]))
    if schema.get("type") == "array":
        return _array_words(schema, link)
    if schema.get("type") == "object" and isinstance(schema.get("additionalProperties"), Mapping):
        return [nodes.Text("table of "), *type_words(schema["additionalProperties"], link)]
    return [nodes.Text(_NAMES.get(schema.get("type", ""), "anything") + _bounds(schema))]


def _enumeration(values: list[Any]) -> Inline:
    parts: list[Inline] = [[literal(json.dumps(value, ensure_ascii=False))] for value in values]
    beginning = [nodes.Text("one of ")] if len(values) > 1 else []
    return [*beginning, *(node for part in _joined(parts, ", ") for node in part)]


def _array_words(schema: Schema, link: Link) -> Inline:
    count = _interval(schema.get("minItems"), schema.get("maxItems"))
    items = schema.get("items") or next(iter(schema.get("prefixItems", ())), {})
    beginning = f"list of {count} values, each " if count else "list, each "
    return [nodes.Text(beginning), *type_words(items, link)]


def _bounds(schema: Schema) -> str:
    """Return the range of a number, or of a text's length, as it follows its type."""
    length = _interval(schema.get("minLength"), schema.get("maxLength"))
    if length:
        return f" of {length} characters"
    interval = _interval(schema.get("minimum"), schema.get("maximum"))
    ends = [interval] if interval else []
    if "exclusiveMinimum" in schema:
        ends.append(f"more than {_number(schema['exclusiveMinimum'])}")
    if "exclusiveMaximum" in schema:
        ends.append(f"less than {_number(schema['exclusiveMaximum'])}")
    if "pattern" in schema:
        ends.append(f"like {schema['pattern']}")
    return "".join(f", {end}" for end in ends)


def _interval(least: float | None, most: float | None) -> str:
    if least is None and most is None:
        return ""
    if most is None:
        return f"{_number(least)} or more"
    if least is None:
        return f"at most {_number(most)}"
    return _number(least) if least == most else f"{_number(least)} to {_number(most)}"


def _number(value: float | None) -> str:
    """Return a bound as a person writes it: with commas from a thousand on."""
    return f"{value:,}" if isinstance(value, int) else f"{value:,.10g}"


def references(schema: object) -> Iterator[str]:
    """Yield the names of the models that a schema mentions, in its order."""
    if isinstance(schema, Mapping):
        if "$ref" in schema:
            yield schema["$ref"].rpartition("/")[2]
        for name, part in schema.items():
            if name != "$ref":
                yield from references(part)
    elif isinstance(schema, list):
        for part in schema:
            yield from references(part)
