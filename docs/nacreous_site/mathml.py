"""Formulas as MathML, which browsers draw themselves: no script, no fonts, nothing from elsewhere.

docutils translates the LaTeX (docutils.utils.math.latex2mathml). MathML Core is drawn by every browser since
Chrome 109 (2023).
"""

from docutils import nodes
from docutils.utils.math import latex2mathml
from sphinx.application import Sphinx
from sphinx.util.math import get_node_equation_number
from sphinx.writers.html5 import HTML5Translator

__all__ = ["use_mathml"]


def use_mathml(app: Sphinx) -> None:
    """Make MathML the way in which HTML has formulas."""
    app.add_html_math_renderer("mathml", (_visit_inline, None), (_visit_block, None))


def _visit_inline(translator: HTML5Translator, node: nodes.math) -> None:
    translator.body.append(_mathml(node.astext(), as_block=False))
    raise nodes.SkipNode


def _visit_block(translator: HTML5Translator, node: nodes.math_block) -> None:
    translator.body.append(translator.starttag(node, "div", CLASS="math"))
    if node.get("number"):
        number = get_node_equation_number(translator, node)
        translator.body.append(f'<span class="eqno">({number})')
        translator.add_permalink_ref(node, "Link to this equation")
        translator.body.append("</span>")
    translator.body.append(_mathml(_aligned(node.astext()), as_block=True))
    translator.body.append("</div>\n")
    raise nodes.SkipNode


def _mathml(latex: str, *, as_block: bool) -> str:
    return str(latex2mathml.tex2mathml(latex, as_block=as_block))


def _aligned(latex: str) -> str:
    """Return several lines as one environment, as Sphinx does for other renderers."""
    return rf"\begin{{aligned}}{latex}\end{{aligned}}" if r"\\" in latex and r"\begin" not in latex else latex
