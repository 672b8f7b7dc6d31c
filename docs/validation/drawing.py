"""How the pictures of the page look alike."""

from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

INK, FAINT, GRID = "#22262b", "#6f7680", "#e3e6ea"
WIDTH_INCH, DOTS_PER_INCH = 8.0, 200
COLUMNS = 1600
"""Of a strip: more than it has pixels, so that no step is seen."""


def figure(height_inch: float) -> "Figure":
    """Return an empty white picture, 1600 pixels wide."""
    from matplotlib.figure import Figure

    return Figure(figsize=(WIDTH_INCH, height_inch), dpi=DOTS_PER_INCH, facecolor="white")


def save(drawn: "Figure", path: Path, palette: int | None = None) -> None:
    """Write a picture as PNG, of so many colours at most."""
    from PIL import Image

    pixels = BytesIO()
    drawn.savefig(pixels, format="png")
    with Image.open(pixels) as picture:
        colours = picture.convert("RGB")
    if palette is not None:
        colours = colours.quantize(palette, dither=Image.Dither.NONE)
    colours.save(path, optimize=True)


def dress(axes: "Axes", title: str, x: str, y: str = "") -> None:
    """Give axes a title, labels and two quiet spines."""
    axes.set_title(title, loc="left", size=10.5, color=INK, weight="bold", pad=8)
    axes.set_xlabel(x, color=INK, size=9)
    axes.set_ylabel(y, color=INK, size=9)
    axes.tick_params(colors=INK, labelsize=8.5)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_color(FAINT)


def strip(axes: "Axes", rows: FloatArray, first: float, last: float) -> None:
    """Fill axes with rows of colours that change from left to right: pixels (rows, N, 3), the upper first."""
    columns = np.linspace(0, rows.shape[1] - 1, COLUMNS)
    known = np.arange(rows.shape[1])
    fine = np.apply_along_axis(lambda channel: np.interp(columns, known, channel), 1, rows)
    axes.imshow(fine, extent=(first, last, 0, 1), aspect="auto", interpolation="nearest")
    axes.set_yticks([])
    for side in ("left", "right", "top"):
        axes.spines[side].set_visible(False)
