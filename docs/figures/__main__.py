"""Render figures of the paper: `make figures`, or `python -m figures [3 4 ...]`, docs and tests on the path.

Without numbers, every figure. Pictures are written to --out, what was measured into --page.
"""

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from figures.figure import Figure, Quality
from figures.page import write_block
from figures.pictures import write_jpeg
from figures.registry import FIGURES
from figures.studio import use_mitsuba
from figures.tables import Tables

DOCS = Path(__file__).parents[1]


def main(arguments: list[str] | None = None) -> None:
    """Do what the command line says."""
    options = parsed(arguments)
    use_mitsuba()
    with TemporaryDirectory() as folder:
        for number in options.numbers or FIGURES:
            make(FIGURES[number], Tables(Path(folder)), options)


def parsed(arguments: list[str] | None) -> argparse.Namespace:
    """Return the options."""
    parser = argparse.ArgumentParser(
        prog="python -m figures", description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("numbers", nargs="*", type=figure_number, metavar="NUMBER")
    parser.add_argument("--out", type=Path, default=DOCS / "images" / "figures", help="folder of pictures")
    parser.add_argument("--page", type=Path, default=DOCS / "paper.md", help="with a place for each figure")
    parser.add_argument("--height", type=int, help="of a panel in pixels, instead of the figure's own")
    parser.add_argument("--samples", type=int, help="paths through each pixel, instead of the figure's own")
    return parser.parse_args(arguments)


def figure_number(text: str) -> int:
    """Return the number of a figure that there is; choices of argparse would refuse no number at all."""
    if text not in map(str, FIGURES):
        raise argparse.ArgumentTypeError(f"expected one of {', '.join(map(str, FIGURES))}, got {text!r}")
    return int(text)


def make(figure: Figure, tables: Tables, options: argparse.Namespace) -> None:
    """Render a figure, write its pictures and its findings, and say how long it took."""
    started = perf_counter()
    sys.stderr.write(f"figure {figure.number} ... ")
    sys.stderr.flush()
    for name, picture in figure.render(tables, chosen_quality(figure, options)).items():
        write_jpeg(picture, options.out / f"{name}.jpg")
    caption = f"The paper's caption: “{figure.caption}”"
    write_block(options.page, figure.name, (caption, "", *figure.findings(tables)))
    sys.stderr.write(f"{perf_counter() - started:.0f} s\n")


def chosen_quality(figure: Figure, options: argparse.Namespace) -> Quality:
    """Return the figure's own, with what the options say instead."""
    chosen = {name: value for name in ("height", "samples") if (value := getattr(options, name))}
    return replace(figure.quality, **chosen)


if __name__ == "__main__":
    main()
