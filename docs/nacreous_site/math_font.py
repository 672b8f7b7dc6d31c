"""STIX Two Math for the formulas: browsers set MathML well only in a font that has a table of its measures.

The font (SIL Open Font License 1.1) comes with the package ziamath. What formulas need of it is written
beside the style sheets when a build ends; nacreous.css names it.
"""

from importlib.resources import as_file, files
from pathlib import Path

from sphinx.application import Sphinx

__all__ = ["use_math_font"]

_CHARACTERS = (
    *range(0x0020, 0x0100),  # Latin
    *range(0x0370, 0x0400),  # Greek
    *range(0x2010, 0x2070),  # punctuation, invisible operators
    *range(0x2100, 0x2150),  # letterlike symbols
    *range(0x2190, 0x2300),  # arrows, operators
    *range(0x27E6, 0x27F0),  # brackets
    *range(0x1D400, 0x1D800),  # mathematical italics and bold letters
)


def use_math_font(app: Sphinx) -> None:
    """Write the font into the site once it is built."""
    app.connect("build-finished", _write)


def _write(app: Sphinx, error: Exception | None) -> None:
    if error is None and app.builder.format == "html":
        with as_file(files("ziamath") / "fonts" / "STIXTwoMath-Regular.ttf") as font:
            _write_subset(font, Path(app.outdir) / "_static" / "stix-two-math.woff")


def _write_subset(font: Path, target: Path) -> None:
    """Write the characters of formulas, and the larger forms that the font has of them."""
    from fontTools.subset import Options, Subsetter, load_font, save_font

    options = Options(flavor="woff", layout_features=["*"], notdef_outline=True)
    loaded = load_font(str(font), options)
    subsetter = Subsetter(options)
    subsetter.populate(unicodes=_CHARACTERS)
    subsetter.subset(loaded)
    save_font(loaded, str(target), options)
