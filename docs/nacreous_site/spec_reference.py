"""The reference of the spec: each model and field of its JSON Schema, from the outside inwards."""

from collections.abc import Iterable, Iterator

from docutils import nodes

from nacreous.tables.spec import json_schema
from nacreous_site.entries import ReferenceDirective, identifier, link, paragraphs, section
from nacreous_site.json_schema import Schema, field_entries, references

__all__ = ["SpecReference", "spec_link", "spec_models"]

_TITLES = {
    "Spec": "The outermost fields",
    "Stack": "`[stack]`",
    "Layer": "A layer",
    "Group": "A group of layers",
    "Surface": "`[surface]`",
    "TableSpec": "`[table]`",
    "Range": "A range",
    "ColourSpec": "`[colour]`",
    "AccuracySpec": "`[accuracy]`",
    "NamedMaterial": "Material: a name",
    "ConstantMaterial": "Material: a constant",
    "TabulatedMaterial": "Material: a table",
    "CauchyMaterial": "Material: a Cauchy formula",
    "SellmeierMaterial": "Material: a Sellmeier formula",
    "SellmeierCoefficients": "Coefficients of a Sellmeier formula",
    "Mixture": "Material: a mixture",
}
"""What a section is called; a model that is not here goes by its own name."""


class SpecReference(ReferenceDirective):
    """``{spec-reference}``: all of a spec."""

    def parts(self) -> Iterable[nodes.Element]:
        """Return a section for each model."""
        return [_model_section(name, model) for name, model in spec_models().items()]


def spec_models() -> dict[str, Schema]:
    """Return the schema of each model of a spec: its own, and then those that it mentions."""
    schema = json_schema()
    models = {**schema["$defs"], "Spec": {name: part for name, part in schema.items() if name != "$defs"}}
    names = ["Spec"]
    for name in names:  # it grows meanwhile: what is mentioned first comes first
        names.extend(found for found in dict.fromkeys(references(models[name])) if found not in names)
    return {name: models[name] for name in names}


def spec_link(model: str) -> nodes.Element:
    """Return a link to the section of a model."""
    return link(_ident(model), *section("", _title(model))[0].children)


def _ident(model: str) -> str:
    return identifier("spec", model.removesuffix("Spec"))


def _title(model: str) -> str:
    return _TITLES.get(model, model)


def _model_section(name: str, model: Schema) -> nodes.section:
    return section(_ident(name), _title(name), *_about(model), *_fields(name, model))


def _about(model: Schema) -> list[nodes.Element]:
    return paragraphs(model.get("description", ""))


def _fields(name: str, model: Schema) -> Iterator[nodes.Element]:
    """Yield the fields of a model; one that a bare name can stand for has them in its other form."""
    for form in (model, *model.get("anyOf", ())):
        yield from field_entries(form, _field_prefix(name), spec_link)


def _field_prefix(model: str) -> str:
    """Return the beginning of a field's id; those of the spec itself have the names of sections."""
    return "spec-field" if model == "Spec" else _ident(model)
