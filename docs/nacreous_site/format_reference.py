"""The reference of the formats: what the registry knows of each, and the manual on top of its module."""

import inspect
import sys
from collections.abc import Iterable

from docutils import nodes

from nacreous.formats.registry import FORMATS, Format
from nacreous.tables.sampling import Sampling
from nacreous.tables.table import Part
from nacreous_site.entries import (
    Inline,
    ReferenceDirective,
    facts,
    identifier,
    literal,
    section,
    words,
)
from nacreous_site.manual import manual

__all__ = ["FormatReference"]

_PARTS = {Part.COLOUR: "linear colours", Part.SPECTRUM: "spectra"}


class FormatReference(ReferenceDirective):
    """``{format-reference}``: every format, in the order of the registry."""

    def parts(self) -> Iterable[nodes.Element]:
        """Return a section for each format."""
        return [_format_section(each) for each in FORMATS.values()]


def _format_section(each: Format) -> nodes.section:
    about, *more = manual(_docstring(each))
    ident = identifier("format", each.name)
    return section(ident, [literal(each.name)], about, *facts(_facts(each)), *more)


def _docstring(each: Format) -> str:
    return inspect.cleandoc(sys.modules[each.write.__module__].__doc__ or "")


def _facts(each: Format) -> dict[str, Inline]:
    return {
        "For": words(each.name.advice),
        "File": [literal(f"film{each.suffix}")],
        "Quantities": _listed(sorted(each.quantities)),
        "Holds": words(_content(each)),
        "Media type": [literal(each.media_type)],
    }


def _content(each: Format) -> str:
    """Return what of a table is in the file, or where its readers want their samples."""
    if each.sampling is not Sampling.AXES:
        return (
            f"samples where its readers want them (`{each.sampling.value}`); the spec's angles are not used"
        )
    held = " and ".join(text for part, text in _PARTS.items() if part in each.holds)
    return f"{held} along the axes of the spec"


def _listed(names: Iterable[str]) -> Inline:
    shown = [[nodes.Text(", "), literal(name)] for name in names]
    return [node for pair in shown for node in pair][1:]
