"""What the site makes of text and schemas that were written without thought of a page."""

import doctest
import json
import subprocess
import sys
from importlib import import_module
from typing import Any
from xml.etree import ElementTree

import pytest
from docutils.utils.math import MathError

from built_site import ROOT, Page
from nacreous_site.json_schema import unit_of
from nacreous_site.mathml import formula
from nacreous_site.repository_links import site_links

ODD_TEXT = """*stars* and **more**, _lines_, [a link](nowhere.md), ![a picture](none.png), <b>tags</b> &
&amp;, {role}`text`, |pipes|, $dollars$, a \\ at the end \\, # no heading,
1. no list, ~~~, --- and `a * in code`

- no list either: http://example.com, name_, `unclosed"""
WORDS = [f"word-{number}_*{number}*" for number in range(500)]
SCHEMA: dict[str, Any] = {
    "properties": {
        "<script>alert(1)</script>": {"type": "string", "description": ODD_TEXT},
        "many": {"enum": WORDS, "default": WORDS[-1]},
        "nested": {"anyOf": [{"oneOf": [{"type": "array", "items": {}}, {"const": None}]}, {"type": "null"}]},
        "nothing_nm": {},
        "long": {"type": "array", "minItems": 3, "maxItems": 3, "default": list(range(1000))},
        "exclusive": {"type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 1e-7},
        "itself": {"$ref": "#/$defs/Odd"},
        "table": {"type": "object", "additionalProperties": {"type": "string", "pattern": "^[*_`]+$"}},
    },
    "required": ["many"],
}
EXTENSION = f"""
import json

from nacreous_site.entries import ReferenceDirective, link, literal, section
from nacreous_site.json_schema import field_entries

SCHEMA = json.loads({json.dumps(json.dumps(SCHEMA))})


class OddReference(ReferenceDirective):
    def parts(self):
        entries = field_entries(SCHEMA, "odd", lambda name: link("odd", literal(name)))
        return [section("odd", "*Odd* `code` _title_ <b>", *entries)]


def setup(app):
    app.add_directive("odd-reference", OddReference)
"""
PAGE = "# Oddities\n\n```{odd-reference}\n```\n\n[back](#odd-many)\n"
CONF = f"""
import sys

sys.path[:0] = [".", {str(ROOT / "docs")!r}]
extensions = ["myst_parser", "odd"]
smartquotes = False
"""


@pytest.fixture(scope="module")
def odd(tmp_path_factory: pytest.TempPathFactory) -> Page:
    """Build a site of one page with the odd schema, warnings being errors."""
    folder = tmp_path_factory.mktemp("odd")
    (folder / "odd.py").write_text(EXTENSION, encoding="utf-8")
    (folder / "conf.py").write_text(CONF, encoding="utf-8")
    (folder / "index.md").write_text(PAGE, encoding="utf-8")
    command = [sys.executable, "-m", "sphinx", "-W", "-n", "-q", ".", "site"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return Page(folder / "site" / "index.html")


def test_text_is_never_taken_for_markup(odd: Page) -> None:
    """What a description holds is on the page as it is; only code in backticks is marked."""
    [entry] = [entry for entry in odd.entries if entry.name == "<script>alert(1)</script>"]
    expected = " ".join(ODD_TEXT.replace("`a * in code`", "a * in code").replace("`text`", "text").split())
    assert expected in " ".join(entry.text.split())
    source = odd.path.read_text(encoding="utf-8")
    assert "<script>alert(1)" not in source
    assert "<b>tags" not in source


def test_long_enumerations_are_whole(odd: Page) -> None:
    """Every word of five hundred is there, once among the words and the last as the default again."""
    [entry] = [entry for entry in odd.entries if entry.name.startswith("many")]
    assert [entry.text.count(json.dumps(word)) for word in WORDS] == [1] * 499 + [2]


def test_every_field_of_an_odd_schema_is_there(odd: Page) -> None:
    """No shape of a schema ends the build, or loses its field."""
    assert [entry.name for entry in odd.entries] == list(SCHEMA["properties"])
    assert "odd-many" in odd.ids


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("[a](../mitsuba/README.md#the-plugin)", "[a](/renderers/mitsuba.md#the-plugin)"),
        ("[a](../../docs/service.md)", "[a](/service.md)"),
        ("[a](zenith.py) ![b](../../docs/images/page.jpg)", "[a](zenith.py) ![b](/images/page.jpg)"),
        ("[a](../mitsuba/scene.py)", "[a](/../clients/mitsuba/scene.py)"),
        (
            "`[a](../README.md)` and ``` [a](../README.md) ```",
            "`[a](../README.md)` and ``` [a](../README.md) ```",
        ),
        ("```sh\n[a](../README.md)\n```", "```sh\n[a](../README.md)\n```"),
        ("[a](https://example.com/README.md) [b](#here)", "[a](https://example.com/README.md) [b](#here)"),
    ],
)
def test_links_of_a_repository_are_links_of_the_site(text: str, expected: str) -> None:
    """A file that a page includes is that page; one of docs is itself; code is left alone."""
    assert site_links(text, ROOT / "clients" / "osl" / "README.md") == expected


@pytest.mark.parametrize(
    ("latex", "expected"),
    [
        (r"n_0\sin\theta", ["<mi>sin</mi>", 'width="0.1667em"', "<mi>θ</mi>"]),
        (r"|r|^2", ['<mo stretchy="false" lspace="0" rspace="0">|</mo>']),
        (r"\psi = 45°", ["45", "∘"]),
        (r"\operatorname{Im}k_z", [">Im</mi>", 'width="0.1667em"']),
        (r"a < b", ["&lt;"]),
    ],
)
def test_formulas_are_mathml(latex: str, expected: list[str]) -> None:
    """Functions stand apart from their arguments, bars do not, and nothing of LaTeX is left."""
    made = formula(latex, as_block=False)
    assert all(part in made for part in expected), made


@pytest.mark.parametrize(
    ("latex", "expected"),
    [
        (r"h = \frac{1}{2}x^2", "h = mfrac(1, 2) msup(x, 2)"),
        (r"(m + \tfrac{1}{2})\lambda", "( m + mfrac(1, 2) ) λ"),
        (r"\frac{\frac{a}{b}}{c}", "mfrac(mfrac(a, b), c)"),
        (r"\bar r_{j+1}", "msub(mover(r, ˉ), j + 1)"),
        (r"{\bar r}_j", "msub(mover(r, ˉ), j)"),
        (r"\bar{E}_w", "msub(mover(E, ˉ), w)"),
        (r"|\bar t_s|^2", "| msub(mover(t, ˉ), s) msup(|, 2)"),
        (r"\bar F^2\bar E_w", "msup(mover(F, ˉ), 2) msub(mover(E, ˉ), w)"),
        (r"n_2^*", "msubsup(n, 2, *)"),
    ],
)
def test_formulas_are_built_as_tex_builds_them(latex: str, expected: str) -> None:
    """A fraction has its two parts, a power its base, and an index stands behind an accented letter."""
    assert outline(latex) == expected


def outline(latex: str) -> str:
    """Return what a formula is built of; a row is its parts with spaces between them."""
    made = formula(latex, as_block=False)
    return _outlined(ElementTree.fromstring(made))  # noqa: S314 - our own output


def _outlined(part: ElementTree.Element) -> str:
    tag = part.tag.rpartition("}")[2]
    inside = [made for child in part if (made := _outlined(child))]
    if not len(part):
        return (part.text or "").strip()
    return " ".join(inside) if tag in {"math", "mrow"} else f"{tag}({', '.join(inside)})"


@pytest.mark.parametrize(
    ("latex", "reason"),
    [
        (r"h = \frac12\left(x\right)^2", r"braces, as in \\frac\{1\}\{2\}"),
        (r"(m + \tfrac12)\lambda", r"braces, as in \\tfrac"),
        (r"\dfrac{1}2", r"braces, as in \\dfrac"),
        (r"\frac{1", "braces"),
        (r"\overline{r}_s", "below the letter"),
    ],
)
def test_formulas_that_would_be_wrong_are_refused(latex: str, reason: str) -> None:
    """Twelve in place of a half, and an index below an overlined letter, are errors that say so."""
    with pytest.raises(MathError, match=reason):
        formula(latex, as_block=False)


def test_units_follow_names() -> None:
    """A length in nanometres, an angle in radians, and numbers without unit."""
    assert [unit_of(name) for name in ("wavelength_nm", "theta_o", "cos_theta", "alpha_x")] == [
        "nm",
        "rad",
        "",
        "",
    ]


MODULES = sorted(file.stem for file in (ROOT / "docs" / "nacreous_site").glob("[a-z]*.py"))


@pytest.mark.parametrize("module", MODULES)
def test_examples_of_the_extension(module: str) -> None:
    """An example in a docstring prints what it says."""
    assert doctest.testmod(import_module(f"nacreous_site.{module}")).failed == 0
