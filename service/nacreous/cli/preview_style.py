"""How the panels of a preview look alike."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["FAINT", "INK", "PAD", "dress", "exposed", "note"]

INK = "#22262b"
FAINT = "#8a9099"
PAD = 8.0
"""Points between axes and their title."""


def dress(axes: "Axes", title: str, x: str, y: str, pad: float = PAD) -> None:
    """Give axes a title, labels and two quiet spines."""
    axes.set_title(title, loc="left", size=12, color=INK, weight="bold", pad=pad)
    axes.set_xlabel(x, color=INK)
    axes.set_ylabel(y, color=INK)
    axes.tick_params(colors=INK, labelsize=9)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_color(FAINT)


def exposed(colours: NDArray[np.float64], exposure: int) -> NDArray[np.float64]:
    """Brighten colours by stops; one that becomes too bright keeps its hue, which clipping would change."""
    bright = colours * 2.0**exposure
    return np.asarray(bright / np.maximum(bright.max(axis=-1, keepdims=True), 1))


def note(axes: "Axes", text: str, pad: float = PAD) -> None:
    """Write a note on the right of the axes' title."""
    style: dict[str, Any] = {"size": 8.5, "color": FAINT, "ha": "right"}
    axes.annotate(text, (1, 1), (0, pad), xycoords="axes fraction", textcoords="offset points", **style)
