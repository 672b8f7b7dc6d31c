"""The reference of the presets: each with its description, the source of its numbers, and its spec."""

from collections.abc import Iterable

from docutils import nodes

from nacreous.tables.presets import preset, preset_names, preset_text
from nacreous_site.entries import (
    ReferenceDirective,
    code_block,
    facts,
    identifier,
    literal,
    paragraphs,
    section,
    words,
)

__all__ = ["PresetReference"]


class PresetReference(ReferenceDirective):
    """``{preset-reference}``: every preset."""

    def parts(self) -> Iterable[nodes.Element]:
        """Return a section for each preset."""
        return [_preset_section(name) for name in preset_names()]


def _preset_section(name: str) -> nodes.section:
    spec = preset(name)
    about = facts({"Source": words(spec.source), "Quantity": [literal(spec.table.quantity)]})
    return section(
        identifier("preset", name),
        [nodes.Text(f"{spec.name} "), literal(name)],
        *paragraphs(spec.description),
        *about,
        code_block(_without_prose(preset_text(name)), "toml"),
    )


def _without_prose(text: str) -> str:
    """Return a spec without the labels that stand above it."""
    return "\n".join(line for line in text.splitlines() if not line.startswith(_PROSE))


_PROSE = ("description = ", "source = ")
