"""The reference of the HTTP service: its OpenAPI document, route by route."""

import json
from collections.abc import Iterable, Iterator, Mapping
from itertools import groupby
from typing import Any

from docutils import nodes

from nacreous.web.app import create_app
from nacreous.web.problem_kinds import MEANINGS, PREFIX
from nacreous.web.settings import Settings
from nacreous_site.entries import (
    Inline,
    ReferenceDirective,
    bullets,
    code_block,
    entry,
    facts,
    identifier,
    link,
    listed,
    literal,
    paragraphs,
    section,
    words,
)
from nacreous_site.json_schema import Schema, field_entries, type_words
from nacreous_site.spec_reference import spec_link, spec_models

__all__ = ["RestReference", "openapi"]

_GROUPS = {
    "tables": "Tables",
    "presets": "Presets",
    "materials": "Materials",
    "jobs": "Jobs",
    "operations": "For those who run it",
}
_METHODS = ("get", "post", "put", "patch", "delete")
_PROBLEM = "application/problem+json"

Operation = tuple[str, str, Mapping[str, Any]]
"""Method, path, and what OpenAPI says of them."""


class RestReference(ReferenceDirective):
    """``{rest-reference}``: routes, then the documents they answer, then the problems."""

    def parts(self) -> Iterable[nodes.Element]:
        """Return the sections."""
        document = openapi()
        yield from _route_sections(document)
        yield section("rest-documents", "Documents", *_models(document))
        yield section("rest-problems", "Problems", *_problem_entries())


def openapi() -> Mapping[str, Any]:
    """Return the document that the service itself answers."""
    return create_app(Settings(store="store")).openapi()


def _operations(document: Mapping[str, Any]) -> Iterator[Operation]:
    for path, methods in document["paths"].items():
        for method in _METHODS:
            if method in methods:
                yield method.upper(), path, methods[method]


def _route_sections(document: Mapping[str, Any]) -> Iterator[nodes.Element]:
    for tag, operations in groupby(_operations(document), key=lambda operation: operation[2]["tags"][0]):
        yield section(identifier("rest", tag), _GROUPS.get(tag, tag), *map(_route_entry, operations))


def _route_entry(operation: Operation) -> nodes.Element:
    method, path, described = operation
    return listed(
        identifier("rest", method, path),
        f"{method} {path}",
        *paragraphs(described.get("description", "")),
        *_labelled("Parameters", bullets(map(_parameter, described.get("parameters", ())))),
        *_body(described.get("requestBody", {})),
        *_labelled("Answers", bullets(_answers(described["responses"]))),
    )


def _labelled(label: str, parts: list[nodes.Element]) -> list[nodes.Element]:
    return [nodes.rubric(label, label), *parts] if parts else []


def _parameter(parameter: Mapping[str, Any]) -> Inline:
    default = parameter["schema"].get("default")
    return [
        literal(parameter["name"]),
        nodes.Text(f" ({parameter['in']}), "),
        *type_words(parameter["schema"], _model_link),
        *words(f", `{default}` without it" if default is not None else ""),
        *words(f": {parameter['description']}"),
    ]


def _body(body: Mapping[str, Any]) -> list[nodes.Element]:
    content = body.get("content", {})
    kinds = bullets([literal(media_type), *_as(media["schema"])] for media_type, media in content.items())
    examples = [part for media_type, media in content.items() for part in _examples(media_type, media)]
    return [*_labelled("Body", kinds), *examples]


def _examples(media_type: str, media: Mapping[str, Any]) -> Iterator[nodes.Element]:
    for name, example in media.get("examples", {}).items():
        value = example["value"]
        shown = value if isinstance(value, str) else json.dumps(value, indent=2, ensure_ascii=False)
        yield nodes.paragraph("", "", nodes.emphasis("", f"{name[0].upper()}{name[1:]}"))
        yield code_block(shown.rstrip(), media_type.rpartition("/")[2])


def _as(schema: Schema) -> Inline:
    described = type_words(schema, _model_link)
    return [nodes.Text(": "), *described] if "$ref" in schema or "anyOf" in schema else []


def _answers(responses: Mapping[str, Any]) -> Iterator[Inline]:
    """Yield the answers in the order of their statuses; problems stand together at the end."""
    problems = []
    for status, answer in sorted(responses.items()):
        if list(answer.get("content", {})) == [_PROBLEM]:
            problems.append(status)
        else:
            yield [literal(status), nodes.Text(" "), *words(_one_line(answer)), *_contents(answer)]
    if problems:
        listed = ", ".join(f"`{status}`" for status in problems)
        yield [link("rest-problems", nodes.Text("problems")), nodes.Text(": "), *words(listed)]


def _one_line(answer: Mapping[str, Any]) -> str:
    return " ".join(answer["description"].split())


def _contents(answer: Mapping[str, Any]) -> Inline:
    """Return the media types of an answer, its document if it is one, and its headers."""
    content = answer.get("content", {})
    documents = [part for media in content.values() for part in _as(media.get("schema", {}))]
    types = ", ".join(f"`{media_type}`" for media_type in content)
    headers = ", ".join(f"`{name}`" for name in answer.get("headers", {}))
    return [
        *words(f" {types}" if types else ""),
        *documents,
        *words(f"; with the header {headers}" if headers else ""),
    ]


def _models(document: Mapping[str, Any]) -> Iterator[nodes.Element]:
    """Yield a section for each document that is no part of a spec."""
    for name, model in document["components"]["schemas"].items():
        if name not in spec_models():
            yield section(_ident(name), [literal(name)], *_model_parts(name, model))


def _model_parts(name: str, model: Schema) -> Iterator[nodes.Element]:
    yield from paragraphs(model.get("description", ""))
    fields = list(field_entries(model, _ident(name), _model_link))
    yield from fields or facts({"Type": type_words(model, _model_link)})


def _model_link(name: str) -> nodes.Node:
    return spec_link(name) if name in spec_models() else link(_ident(name), literal(name))


def _ident(model: str) -> str:
    return identifier("rest-document", model)


def _problem_entries() -> Iterator[nodes.Element]:
    for kind, meaning in MEANINGS.items():
        yield entry(identifier("problem", kind), f"{PREFIX}{kind}", *paragraphs(meaning))
