"""Formulas as MathML, which browsers draw themselves: no script, nothing from elsewhere.

docutils translates the LaTeX (docutils.utils.math.latex2mathml). MathML Core is drawn by every browser since
Chrome 109 (2023).
"""

import re
from html import escape

from docutils import nodes
from docutils.utils.math import MathError, latex2mathml
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.util.math import get_node_equation_number
from sphinx.writers.html5 import HTML5Translator

__all__ = ["formula", "use_mathml"]

_LOGGER = logging.getLogger(__name__)
_FUNCTION = re.compile(
    r"(?P<factor>(?<=[\w})])\s*)?"
    r"(?P<name>\\(?:sin|cos|tan|exp|ln|log|arg|Re|Im|operatorname\{\w+\})(?![A-Za-z])(?:\^(?:\w|\{[^}]*\}))?)\s*"
    r"(?P<argument>(?=[\w\\])(?!\\(?:left|big|,)))?"
)
_BAR = re.compile(r"<mo(?: stretchy=\"false\")?>([|‖⟨⟩])</mo>")
_SYNONYMS = {r"\dots": r"\ldots", "°": r"^{\circ}"}


def use_mathml(app: Sphinx) -> None:
    """Make MathML the way in which HTML has formulas."""
    app.add_html_math_renderer("mathml", (_visit_inline, None), (_visit_block, None))


def _visit_inline(translator: HTML5Translator, node: nodes.math) -> None:
    translator.body.append(_mathml(node, node.astext(), as_block=False))
    raise nodes.SkipNode


def _visit_block(translator: HTML5Translator, node: nodes.math_block) -> None:
    translator.body.append(translator.starttag(node, "div", CLASS="math"))
    if node.get("number"):
        number = get_node_equation_number(translator, node)
        translator.body.append(f'<span class="eqno">({number})')
        translator.add_permalink_ref(node, "Link to this equation")
        translator.body.append("</span>")
    translator.body.append(_mathml(node, _aligned(node.astext()), as_block=True))
    translator.body.append("</div>\n")
    raise nodes.SkipNode


def _mathml(node: nodes.Element, latex: str, *, as_block: bool) -> str:
    """Return a formula, or its LaTeX and a warning where docutils does not know a command."""
    try:
        return formula(latex, as_block=as_block)
    except (MathError, AttributeError) as error:  # the second where an & stands outside of an array
        _LOGGER.warning("%s: %s", error, latex, location=node)
        return f"<code>{escape(latex)}</code>"


def formula(latex: str, *, as_block: bool) -> str:
    """Return the MathML of a formula in LaTeX; raises `MathError` where docutils does not know a command."""
    made = latex2mathml.tex2mathml(_known(latex), as_block=as_block)
    return _BAR.sub(r'<mo stretchy="false" lspace="0" rspace="0">\1</mo>', made)  # no relation, no growth


def _known(latex: str) -> str:
    """Return LaTeX in the words that docutils knows."""
    for name, known in _SYNONYMS.items():
        latex = latex.replace(name, known)
    return _FUNCTION.sub(_spaced, latex)


def _spaced(function: re.Match[str]) -> str:
    """Return a function with the thin spaces that TeX sets about one, and docutils does not."""
    before, after = ("" if function[side] is None else r"\," for side in ("factor", "argument"))
    return f"{before}{function['name'].strip()}{after}"


def _aligned(latex: str) -> str:
    """Return several lines as one environment, as Sphinx does for other renderers."""
    return rf"\begin{{aligned}}{latex}\end{{aligned}}" if r"\\" in latex and r"\begin" not in latex else latex
