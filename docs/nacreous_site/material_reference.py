"""The reference of named materials: each entry of the library, with whose numbers it has."""

import json
from collections.abc import Iterable

from docutils import nodes

from nacreous.optics.library import LibraryMaterial, library_material, library_names
from nacreous_site.entries import (
    Inline,
    ReferenceDirective,
    entry,
    facts,
    identifier,
    literal,
    paragraphs,
    words,
)
from nacreous_site.spec_reference import spec_link

__all__ = ["MaterialReference"]


class MaterialReference(ReferenceDirective):
    """``{material-reference}``: the materials that have a name of their own."""

    def parts(self) -> Iterable[nodes.Element]:
        """Return an entry for each material."""
        return [_material_entry(name, library_material(name)) for name in library_names()]


def _material_entry(name: str, material: LibraryMaterial) -> nodes.Element:
    first, last = material.range_nm
    return entry(
        identifier("material", name),
        name,
        *paragraphs(material.note),
        *facts(
            {
                "Range": words(f"{first:,.10g} to {last:,.10g} nm"),
                "Index": _index(material),
                "Source": words(material.citation),
            }
        ),
    )


def _index(material: LibraryMaterial) -> Inline:
    """Return the form of the index, with its numbers where they are few."""
    model = material.model
    document = model.model_dump(mode="json", exclude_defaults=True)
    text = document if isinstance(document, str) else json.dumps(document)
    form = spec_link(type(model).__name__)
    return [form] if len(text) > _LONGEST else [form, nodes.Text(": "), literal(text)]


_LONGEST = 200
"""Characters of an index that a reader may want to see; tables have thousands."""
