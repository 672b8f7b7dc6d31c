"""A module's docstring, which is reStructuredText, as nodes of a page."""

from docutils import nodes
from docutils.core import publish_doctree

__all__ = ["manual"]

_SETTINGS = {"report_level": 2, "halt_level": 2, "file_insertion_enabled": False}
"""A warning is an error here, too."""


def manual(docstring: str) -> list[nodes.Element]:
    """Return the paragraphs and tables of a docstring; what stands in single backticks is code.

    Raises
    ------
    docutils.utils.SystemMessage
        The docstring is no reStructuredText.
    """
    document = publish_doctree(docstring, settings_overrides=_SETTINGS)
    for name in list(document.findall(nodes.title_reference)):
        name.replace_self(nodes.literal(name.astext(), name.astext()))
    return [part for part in document.children if isinstance(part, nodes.Element)]
