"""What the docstring of a value says of its fields: the JSON Schema says it in the same words.

Docstrings are in numpy's style. What stands before their sections is the value's own description.
"""

import inspect
import re

__all__ = ["field_descriptions", "summary"]

_SECTION = re.compile(r"^\w[\w ]*\n-{3,}\n", re.MULTILINE)
_PARAMETERS = re.compile(r"^Parameters\n-{3,}\n", re.MULTILINE)
_ENTRY = re.compile(r"^(?P<names>\w+(?:, \w+)*) : [^\n]*(?P<text>(?:\n(?: +[^\n]*)?)*)", re.MULTILINE)


def summary(docstring: str) -> str:
    """Return what stands before the sections of a docstring."""
    return _plain(_SECTION.split(inspect.cleandoc(docstring), maxsplit=1)[0])


def field_descriptions(docstring: str) -> dict[str, str]:
    """Return the text of each parameter that a docstring describes; several names may share one.

    >>> from nacreous.optics.material import ConstantMaterial
    >>> field_descriptions(ConstantMaterial.__doc__)["n"]
    'Refractive index.'
    """
    _, *described = _PARAMETERS.split(inspect.cleandoc(docstring), maxsplit=1)
    entries = _ENTRY.finditer(_SECTION.split(described[0], maxsplit=1)[0] if described else "")
    texts = {name: _one_line(entry["text"]) for entry in entries for name in entry["names"].split(", ")}
    return {name: text for name, text in texts.items() if text}


def _one_line(text: str) -> str:
    return " ".join(_plain(text).split())


def _plain(text: str) -> str:
    """Return text with code in single backticks, as every reader of a schema shows it."""
    return text.replace("``", "`").strip()
