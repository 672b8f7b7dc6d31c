"""A colour chart of the literature beside the colours that a film has at these thicknesses.

A colour of a chart is a word. Here a word is a range of hues: the literature's word stands for one or two of
the words of figures/hue.py, whose bounds are Munsell's. For "metallic" and "silver" it is a chroma, below
`COLOURLESS`, which is not the chroma below which figures/hue.py says grey. A word holds where the film's
colour is within; how far that is from the chart's thickness is the word's offset.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from figures.hue import HUES
from validation.appearance import lightness_chroma_hue, shown
from validation.baseline import baseline, shuffled
from validation.drawing import FAINT, INK, dress, figure, strip
from validation.film_colours import colours_over_thickness
from validation.page import table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

TOLERANCE_NM = 20.0
FARTHEST_NM = 60.0
"""Farther away, a colour is that of another order."""
COLOURLESS = 12.0
"""C* below which a film may be called silver or metallic, and is called grey here.

figures/hue.py says grey below C* 4 alone. The charts' words are for metals, which have a tint: bare silicon,
bluish, has C* 6, and bare titanium, yellowish, has 4. The bound is twice that of silicon, and about Munsell's
chroma 2. Any bound of 10 to 15 gives the same offsets; below 7, "metallic" holds nowhere.
"""
MISSED = "#c23b22"
DARK = 50.0
"""L* below which a colour is called dark."""

WORDS = {
    "gold": ("orange", "yellow"),
    "orange": ("orange",),
    "yellow": ("yellow",),
    "green": ("green",),
    "cyan": ("cyan",),
    "blue": ("blue",),
    "blue-violet": ("blue", "violet"),
    "violet": ("violet", "purple"),
    "purple": ("violet", "purple"),
    "red-violet": ("purple", "magenta"),
    "pink": ("magenta", "red"),
    "red": ("magenta", "red"),
    "scarlet": ("magenta", "red"),
    "bluish red": ("magenta",),
    "bluish green": ("cyan",),
    "greenish blue": ("cyan",),
    "indigo": ("blue", "violet"),
}
"""What the names of the charts may be, in the words of figures/hue.py, by name or by its noun."""


@dataclass(frozen=True)
class ChartColour:
    """A line of a chart: a thickness and what it is called, the noun last."""

    thickness_nm: float
    name: str

    @property
    def words(self) -> tuple[str, ...]:
        """Return the words that the colour may have; none if it is colourless."""
        return WORDS.get(self.name) or WORDS.get(self.name.split()[-1], ())

    def holds(self, look: FloatArray) -> NDArray[np.bool_]:
        """Say which of some lightnesses, chromas and hues, (N, 3), may be called so."""
        lightness, chroma, hue_deg = look.T
        dark = lightness < DARK if self.name.startswith("dark") else np.full(len(look), fill_value=True)
        hue_fits = np.isin(words_of(hue_deg), self.words) if self.words else chroma < COLOURLESS
        return dark & hue_fits


@dataclass(frozen=True, eq=False)
class NamedChart:
    """A chart and the film's colours.

    Parameters
    ----------
    title : str
    colours : tuple of ChartColour
    thickness_nm, rgb : float arrays, shape (N,) and (N, 3)
        Linear Rec.709 under D65 at normal incidence.
    """

    title: str
    colours: tuple[ChartColour, ...]
    thickness_nm: FloatArray
    rgb: FloatArray

    @property
    def look(self) -> FloatArray:
        """Return lightness, chroma and hue, (N, 3)."""
        return lightness_chroma_hue(self.rgb)

    def offset_nm(self, colour: ChartColour) -> float:
        """Return how far from its thickness a name holds first, NaN if nowhere near."""
        away = self.thickness_nm[colour.holds(self.look)] - colour.thickness_nm
        near = away[np.abs(away) <= FARTHEST_NM]
        return float(near[np.abs(near).argmin()]) if near.size else np.nan

    @property
    def offsets_nm(self) -> FloatArray:
        """Return the offset of each colour."""
        return np.array([self.offset_nm(colour) for colour in self.colours])

    @property
    def kept(self) -> NDArray[np.bool_]:
        """Say which names hold within the tolerance."""
        return self.kept_within(TOLERANCE_NM)

    def kept_within(self, tolerance_nm: float) -> NDArray[np.bool_]:
        """Say which names hold within so many nm."""
        return np.abs(self.offsets_nm) <= tolerance_nm


def words_of(hue_deg: FloatArray) -> NDArray[np.str_]:
    """Return the word of figures/hue.py for each hue."""
    bounds, words = (np.array(column) for column in zip(*HUES, strict=True))
    return words[np.searchsorted(bounds, hue_deg, side="right") - 1]


def measure(title: str, preset: str, colours: tuple[ChartColour, ...], most_nm: int) -> NamedChart:
    """Compute the colours of a preset in steps of 1 nm."""
    thickness_nm = np.arange(1.0, most_nm + 1)
    return NamedChart(title, colours, thickness_nm, colours_over_thickness(preset, thickness_nm))


# ---- in words ----------------------------------------------------------------------------------------------


def headline(chart: NamedChart) -> str:
    """Say how many names hold, and how far off those are at most."""
    farthest = np.abs(chart.offsets_nm[chart.kept]).max()
    return f"{count(chart)}, the farthest of them {farthest:.0f} nm off"


def count(chart: NamedChart) -> str:
    """Say how many names hold, and how many would by chance."""
    return (
        f"{chart.kept.sum()} of {chart.kept.size} names hold within ±{TOLERANCE_NM:.0f} nm (by chance "
        f"{shuffled(chart, TOLERANCE_NM):.1f})"
    )


def numbers(chart: NamedChart) -> str:
    """Say how many names hold, and where each does."""
    offsets = chart.offsets_nm
    summary = (
        f"**{headline(chart)}**; "
        f"{(offsets == 0).sum()} hold at the very thickness of the chart, and the offsets found "
        f"have a mean of {np.nanmean(np.abs(offsets)):.0f} nm."
    )
    header = (
        "chart, nm: | name in the chart | hue words it may be | computed there | h_ab, °: | C*: | offset, nm:"
    )
    rows = table(header, [_row(chart, each) for each in chart.colours])
    return f"{summary}\n\n{baseline(chart, TOLERANCE_NM)}\n\n{rows}"


def _row(chart: NamedChart, colour: ChartColour) -> str:
    _, chroma, hue = chart.look[int(np.abs(chart.thickness_nm - colour.thickness_nm).argmin())]
    word = "grey" if chroma < COLOURLESS else str(words_of(np.array([hue]))[0])
    may_be = " or ".join(colour.words or (f"C* below {COLOURLESS:.0f}",))
    offset = chart.offset_nm(colour)
    away = "none near" if np.isnan(offset) else f"{offset:+.0f}" if offset else "0"
    cells = (f"{colour.thickness_nm:.0f}", colour.name, may_be, word, f"{hue:.0f}", f"{chroma:.0f}", away)
    return " | ".join(cells)


# ---- as a picture ------------------------------------------------------------------------------------------


def draw(chart: NamedChart) -> "Figure":
    """Draw the colours over thickness, with the chart's names where it has them, and their hues."""
    drawn = figure(4.0)
    swatches = drawn.add_axes((0.075, 0.565, 0.845, 0.2))
    hues = drawn.add_axes((0.075, 0.13, 0.845, 0.38))
    _draw_strip(swatches, chart)
    _draw_hues(hues, chart)
    drawn.suptitle(chart.title, x=0.02, y=0.975, ha="left", size=11, weight="bold", color=INK)
    return drawn


def _draw_strip(axes: "Axes", chart: NamedChart) -> None:
    first, last = chart.thickness_nm[[0, -1]]
    strip(axes, shown(chart.rgb, float(chart.rgb.max()))[None], first, last)
    axes.set_xticks([])
    axes.spines["bottom"].set_visible(False)
    for colour, kept in zip(chart.colours, chart.kept, strict=True):
        axes.plot([colour.thickness_nm] * 2, [1, 1.1], color=INK, lw=0.9, clip_on=False)
        axes.text(
            *(colour.thickness_nm, 1.16), colour.name, rotation=42, size=8.5, color=INK,
            ha="left", va="bottom", rotation_mode="anchor", style="normal" if kept else "italic",
        )  # fmt: skip


def _draw_hues(axes: "Axes", chart: NamedChart) -> None:
    look, pixels = chart.look, shown(chart.rgb, float(chart.rgb.max()))
    bounds = [bound for bound, _ in HUES]
    axes.hlines(bounds, *chart.thickness_nm[[0, -1]], color="#e3e6ea", lw=0.7, zorder=0)
    for (bound, word), end in zip(HUES, [*bounds[1:], 371], strict=True):
        middle = (bound + end) / 2 if word != "magenta" else 347
        axes.text(chart.thickness_nm[-1] * 1.008, middle, word, size=6.8, color=FAINT, va="center")
    axes.scatter(chart.thickness_nm, look[:, 2], c=pixels, s=9, linewidths=0)
    for colour, offset_nm in zip(chart.colours, chart.offsets_nm, strict=True):
        at = int(colour.thickness_nm - chart.thickness_nm[0])
        style = {"facecolors": [pixels[at]], "clip_on": False, **_ring(offset_nm)}
        axes.scatter([colour.thickness_nm], [look[at, 2]], s=64, zorder=3, **style)
    axes.set_xlim(*chart.thickness_nm[[0, -1]])
    axes.set_ylim(0, 360)
    axes.set_yticks([0, 90, 180, 270, 360])
    dress(axes, "", "thickness of the film, nm", r"CIELAB hue $h_{ab}$, degrees")


def _ring(offset_nm: float) -> dict[str, Any]:
    """Return the ring of a name: solid where it holds at its thickness, broken where it holds near."""
    if offset_nm == 0:
        return {"edgecolors": INK, "linewidths": 1.3}
    if abs(offset_nm) <= TOLERANCE_NM:
        return {"edgecolors": INK, "linewidths": 1.1, "linestyles": [(0, (1.6, 1.6))]}
    return {"edgecolors": MISSED, "linewidths": 1.3}
