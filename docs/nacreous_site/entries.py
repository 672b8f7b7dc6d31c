"""The parts of a reference page as nodes of docutils.

Text is data here: it becomes nodes and is never parsed as Markdown, so that nothing in it, a star, a bracket
or an underscore, can be taken for markup. Only code in backticks is marked.
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from docutils import nodes
from sphinx import addnodes
from sphinx.util.docutils import SphinxDirective

__all__ = [
    "Inline",
    "ReferenceDirective",
    "bullets",
    "code_block",
    "entry",
    "facts",
    "identifier",
    "link",
    "listed",
    "literal",
    "paragraphs",
    "section",
    "words",
]

Inline = Sequence[nodes.Node]

_CODE = re.compile(r"(?<!`)(`{1,2})(?!`)(?P<code>[^`]+)(?<!`)\1(?!`)")
_NO_IDENTIFIER = re.compile(r"[^a-z0-9]+")


class ReferenceDirective(SphinxDirective):
    """A directive without content, whose `parts` are its page."""

    has_content = False

    def run(self) -> list[nodes.Node]:
        """Return the parts, with everything that has an id known as a target of links."""
        self.env.note_reread()  # the code may have changed where the page has not
        parts = list(self.parts())
        for part in parts:
            for node in part.findall(nodes.Element):
                self._note_targets(node)
        return parts

    def parts(self) -> Iterable[nodes.Element]:
        """Return what stands on the page."""
        raise NotImplementedError

    def _note_targets(self, node: nodes.Element) -> None:
        for name in node["names"]:
            node["ids"] = [name]
            self.state.document.note_explicit_target(node, node)
            if isinstance(node, addnodes.desc_signature):  # Sphinx itself labels sections alone
                self._label(name, node.astext())

    def _label(self, name: str, title: str) -> None:
        standard = self.env.domains.standard_domain
        standard.labels[name] = (self.env.docname, name, title)
        standard.anonlabels[name] = (self.env.docname, name)


def identifier(*parts: str) -> str:
    """Return an id, as HTML and links have it, of names one below the other.

    >>> identifier("spec", "table", "cos_theta")
    'spec-table-cos-theta'
    """
    return _NO_IDENTIFIER.sub("-", "-".join(parts).lower()).strip("-")


def words(text: str) -> list[nodes.Node]:
    """Return the nodes of one line of text, with what stands in backticks as code."""
    return list(_words(text))


def _words(text: str) -> Iterator[nodes.Node]:
    end = 0
    for found in _CODE.finditer(text):
        yield nodes.Text(text[end : found.start()])
        yield literal(found["code"])
        end = found.end()
    yield nodes.Text(text[end:])


def paragraphs(text: str) -> list[nodes.Element]:
    """Return the paragraphs of a text; an empty line parts them."""
    return [
        nodes.paragraph("", "", *words(" ".join(part.split()))) for part in text.split("\n\n") if part.strip()
    ]


def literal(text: str) -> nodes.literal:
    """Return text as code."""
    return nodes.literal(text, text)


def link(ident: str, *children: nodes.Node) -> nodes.Element:
    """Return a link to an id of the site."""
    return addnodes.pending_xref(
        "",
        nodes.inline("", "", *children),
        refdomain="std",
        reftype="ref",
        reftarget=ident,
        refexplicit=True,
        refwarn=True,
    )


def section(ident: str, title: str | Inline, *children: nodes.Node) -> nodes.section:
    """Return a section that links reach by its id."""
    heading = words(title) if isinstance(title, str) else title
    return nodes.section("", nodes.title("", "", *heading), *children, names=[ident])


def entry(ident: str, name: str, *body: nodes.Node, note: str = "") -> addnodes.desc:
    """Return the entry of one thing that has a name; `note` stands beside it."""
    signature = addnodes.desc_signature("", "", addnodes.desc_name(name, name), names=[ident])
    if note:
        signature += addnodes.desc_annotation("", "", nodes.Text(f"  {note}"))
    content = addnodes.desc_content("", *body)
    return addnodes.desc(
        "", signature, content, domain="nacreous", objtype="entry", classes=["nacreous-entry"]
    )


def listed(ident: str, name: str, *body: nodes.Node) -> addnodes.desc:
    """Return an entry that the page's table of contents lists."""
    described = entry(ident, name, *body)
    described[0].attributes |= {"_toc_name": name, "_toc_parts": (name,)}
    return described


def facts(named: Mapping[str, Inline]) -> list[nodes.Element]:
    """Return a list of facts by name, without those that are empty."""
    fields = [
        nodes.field("", nodes.field_name(name, name), nodes.field_body("", nodes.paragraph("", "", *fact)))
        for name, fact in named.items()
        if fact
    ]
    return [nodes.field_list("", *fields, classes=["nacreous-facts"])] if fields else []


def bullets(items: Iterable[Inline]) -> list[nodes.Element]:
    """Return a list of short items; nothing where there are none."""
    listed = [nodes.list_item("", nodes.paragraph("", "", *item)) for item in items]
    return [nodes.bullet_list("", *listed)] if listed else []


def code_block(text: str, language: str) -> nodes.literal_block:
    """Return a block of code."""
    return nodes.literal_block(text, text, language=language)
