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
    r"(?P<name>\\(?:(?:sin|cos|tan|exp|ln|log|arg|Re|Im)(?![A-Za-z])|operatorname\{\w+\})(?:\^(?:\w|\{[^}]*\}))?)\s*"
    r"(?P<argument>(?=[\w\\])(?!\\(?:left|big|,)))?"
)
_BAR = re.compile(r"<mo(?: stretchy=\"false\")?>([|‖⟨⟩])</mo>")
_FRACTION = re.compile(r"\\[tdc]?frac(?![A-Za-z])\s*")
_LETTER = r"(?:\\[A-Za-z]+|\w|\{[^{}]*\})"
_ACCENT = r"\\(?:bar|hat|tilde|vec|dot|ddot|check|breve|acute|grave|mathring)(?![A-Za-z])"
_INDEXED = re.compile(
    rf"(?:(?P<accent>{_ACCENT})\s*(?P<of>{_LETTER})|\{{(?P<braced>{_ACCENT}\s*{_LETTER})\}})\s*(?=_)"
)
_LOST_INDEX = re.compile(r"<mo (?:stretchy=\"false\"|accent=\"true\")>[^<]*</mo>\s*</munderover>")
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
    """Return the MathML of a formula in LaTeX; raises `MathError` where it would be drawn wrongly."""
    _demand_braces(latex)
    made = latex2mathml.tex2mathml(_known(latex), as_block=as_block)
    if _LOST_INDEX.search(made):
        raise MathError("an index of an accented letter would be drawn below the letter")
    return _BAR.sub(r'<mo stretchy="false" lspace="0" rspace="0">\1</mo>', made)  # no relation, no growth


def _demand_braces(latex: str) -> None:
    """Refuse fractions without braces: of one half, written 12, docutils makes twelve over what follows."""
    for fraction in _FRACTION.finditer(latex):
        numerator = _group_end(latex, fraction.end())
        if numerator is None or _group_end(latex, numerator) is None:
            name = fraction[0].strip()
            raise MathError(f"numerator and denominator want braces, as in {name}{{1}}{{2}}")


def _group_end(latex: str, start: int) -> int | None:
    """Return where a group in braces ends, with the spaces after it; None where none begins or it is open."""
    depth = 0
    for brace in re.finditer(r"\\.|[{}]|\S", latex[start:]):
        depth += {"{": 1, "}": -1}.get(brace[0], 0)
        if depth <= 0:
            return start + brace.end() if brace[0] == "}" else None
    return None


def _known(latex: str) -> str:
    """Return LaTeX in the words that docutils knows."""
    for name, known in _SYNONYMS.items():
        latex = latex.replace(name, known)
    latex = _INDEXED.sub(_enclosed, latex)
    return _FUNCTION.sub(_spaced, latex)


def _enclosed(indexed: re.Match[str]) -> str:
    """Return an accented letter as a row of its own, or docutils sets its index as a limit below it."""
    accented = indexed["braced"] or f"{indexed['accent']} {indexed['of']}"
    return rf"{{{accented}{{}}}}"


def _spaced(function: re.Match[str]) -> str:
    """Return a function with the thin spaces that TeX sets about one, and docutils does not."""
    before, after = ("" if function[side] is None else r"\," for side in ("factor", "argument"))
    return f"{before}{function['name'].strip()}{after}"


def _aligned(latex: str) -> str:
    """Return several lines as one environment, as Sphinx does for other renderers."""
    return rf"\begin{{aligned}}{latex}\end{{aligned}}" if r"\\" in latex and r"\begin" not in latex else latex
