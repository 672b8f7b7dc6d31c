"""Newton's colours of a free soap film against Michel-Lévy's path differences and Newton's own table.

A film in air loses half a wave at its front and none at its back, so that it is black where it is thin. It
reflects 4 r² sin²(pi path / wavelength) with path = 2 n d, but for echoes of r⁴: the law by which crystals
between crossed polarisers are coloured, with their retardation as the path. Two witnesses give paths:

* The sensitive tints, the dark purples at which red turns to blue and the next order begins: 551, 1101 and
  1652 nm on Michel-Lévy's chart (A. Michel-Lévy and A. Lacroix, Les minéraux des roches, 1888; B. E.
  Sørensen, Eur. J. Mineral. 25, 5-10 (2013)). They are dark because the light that the eye sees best is
  extinguished, so they are looked for where the luminance has its minima.
* I. Newton, Opticks, 1704, book II, part II: thicknesses of air, in millionths of an inch, at which each
  colour is most intense; he has three quarters of them for water. The path is twice the thickness of air.
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from nacreous.optics.refractive_index import refractive_index
from nacreous.tables.presets import preset
from validation import named_chart
from validation.appearance import LUMINANCE, lightness_chroma_hue, shown
from validation.baseline import baseline, shuffled
from validation.comparison import Comparison
from validation.drawing import FAINT, INK, dress, figure, strip
from validation.film_colours import colours_over_thickness
from validation.named_chart import TOLERANCE_NM, ChartColour, NamedChart, words_of
from validation.page import table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

TINTS_NM = (551.0, 1101.0, 1652.0)
"""Path differences of the sensitive tints of the first three orders."""
INCH_NM = 25.4e6
THICKEST_NM = 1250
INDEX_AT_NM = 551.0
TINT = "#a03c8c"
APART_NM = 21.0
"""Between two names in the picture."""


@dataclass(frozen=True)
class NewtonColour:
    """A line of Newton's table: order, colour, thickness of air in millionths of an inch."""

    order: int
    name: str
    air: float

    @property
    def path_nm(self) -> float:
        """Return the path to and fro."""
        return 2 * self.air * 1e-6 * INCH_NM


NEWTON = (
    NewtonColour(1, "black", 1),
    NewtonColour(1, "blue", 2 + 2 / 5),
    NewtonColour(1, "white", 5 + 1 / 4),
    NewtonColour(1, "yellow", 7 + 1 / 9),
    NewtonColour(1, "orange", 8),
    NewtonColour(1, "red", 9),
    NewtonColour(2, "violet", 11 + 1 / 6),
    NewtonColour(2, "indigo", 12 + 5 / 6),
    NewtonColour(2, "blue", 14),
    NewtonColour(2, "green", 15 + 1 / 8),
    NewtonColour(2, "yellow", 16 + 2 / 7),
    NewtonColour(2, "orange", 17 + 2 / 9),
    NewtonColour(2, "red", 18 + 1 / 3),
    NewtonColour(2, "scarlet", 19 + 2 / 3),
    NewtonColour(3, "purple", 21),
    NewtonColour(3, "indigo", 22 + 1 / 10),
    NewtonColour(3, "blue", 23 + 2 / 5),
    NewtonColour(3, "green", 25 + 1 / 5),
    NewtonColour(3, "yellow", 27 + 1 / 7),
    NewtonColour(3, "red", 29),
    NewtonColour(3, "bluish red", 32),
    NewtonColour(4, "bluish green", 34),
    NewtonColour(4, "green", 35 + 2 / 7),
    NewtonColour(4, "yellowish green", 36),
    NewtonColour(4, "red", 40 + 1 / 3),
)
"""Of the first four orders; three more are nearly white."""


@dataclass(frozen=True, eq=False)
class NewtonSeries:
    """A soap film in air.

    Parameters
    ----------
    n : float
        Its index at the wavelength of the first sensitive tint.
    thickness_nm, rgb : float arrays, shape (N,) and (N, 3)
        Linear Rec.709 under D65 at normal incidence, the brightest luminance being 1.
    """

    n: float
    thickness_nm: FloatArray
    rgb: FloatArray

    @property
    def path_nm(self) -> FloatArray:
        """Return 2 n d."""
        return 2 * self.n * self.thickness_nm

    @property
    def luminance(self) -> FloatArray:
        """Return Y, 1 where it is brightest."""
        return self.rgb @ LUMINANCE

    @cached_property
    def tint_paths_nm(self) -> FloatArray:
        """Return the paths of the darkest thicknesses between two brighter ones, after the black film."""
        Y = self.luminance  # noqa: N806 - the symbol
        darkest = np.flatnonzero((Y[1:-1] < Y[:-2]) & (Y[1:-1] <= Y[2:])) + 1
        return self.path_nm[darkest]

    @cached_property
    def newtons_chart(self) -> NamedChart:
        """Return the colours that Newton names, as a chart of this film's thicknesses."""
        names = tuple(ChartColour(each.path_nm / (2 * self.n), each.name) for each in NEWTON)
        return NamedChart("", names, self.thickness_nm, self.rgb)


def measure() -> NewtonSeries:
    """Compute the colours of the preset soap-bubble from 1 nm on."""
    thickness_nm = np.arange(1.0, THICKEST_NM + 1)
    film = preset("soap-bubble").stack.layers[0]
    n = float(refractive_index(film.material, INDEX_AT_NM)[0].real)
    rgb = colours_over_thickness("soap-bubble", thickness_nm)
    return NewtonSeries(n, thickness_nm, rgb / (rgb @ LUMINANCE).max())


def headline(series: NewtonSeries) -> str:
    """Say how near the tints are, and how many of Newton's names hold."""
    apart = max(abs(path_nm / known_nm - 1) for known_nm, path_nm in _tints(series))
    return f"three tints within {100 * apart:.1f} %; {named_chart.count(series.newtons_chart)}"


def numbers(series: NewtonSeries) -> str:
    """Say where the sensitive tints are, and how Newton's names fare."""
    header = (
        "sensitive tint of order: | path, Michel-Lévy, nm: | path 2 n d, computed, nm: | apart, %: | "
        "thickness of the film, nm: | hue h_ab, °: | word"
    )
    rows = [_row(series, order, *pair) for order, pair in enumerate(_tints(series), start=1)]
    chart = series.newtons_chart
    newton = (
        f"**{named_chart.headline(chart)}**, of the colours that Newton names in his first four orders; the "
        f"median offset is "
        f"{np.nanmedian(np.abs(chart.offsets_nm)):.0f} nm; n = {series.n:.3f} at {INDEX_AT_NM:.0f} nm."
    )
    return f"{table(header, rows)}\n\n{newton} {_missed(chart)}\n\n{_by_chance(chart)}"


def _by_chance(chart: NamedChart) -> str:
    """Say how far his names are apart, and how many hold by chance within 20 nm and within half of that."""
    step_nm = float(np.median(np.diff([each.thickness_nm for each in chart.colours])))
    kept = int(chart.kept_within(step_nm / 2).sum())
    return (
        f"{baseline(chart, TOLERANCE_NM)} Newton's names are {step_nm:.0f} nm of water apart in the median, "
        f"so that {TOLERANCE_NM:.0f} nm is nearly a step. Within half a step, {step_nm / 2:.0f} nm, {kept} "
        f"hold; by chance, {shuffled(chart, step_nm / 2):.1f} would."
    )


def _tints(series: NewtonSeries) -> list[tuple[float, float]]:
    return list(zip(TINTS_NM, series.tint_paths_nm, strict=False))


def _row(series: NewtonSeries, order: int, known_nm: float, path_nm: float) -> str:
    hue = lightness_chroma_hue(series.rgb[int(np.abs(series.path_nm - path_nm).argmin())])[2]
    cells = (
        f"{order}", f"{known_nm:.0f}", f"{path_nm:.0f}", f"{100 * (path_nm / known_nm - 1):+.1f}",
        f"{path_nm / (2 * series.n):.0f}", f"{hue:.0f}", str(words_of(np.array([hue]))[0]),
    )  # fmt: skip
    return " | ".join(cells)


def _missed(chart: NamedChart) -> str:
    lines = zip(NEWTON, chart.kept, chart.offsets_nm, strict=True)
    missed = [f"{line.name} of order {line.order} ({away:+.0f} nm)" for line, kept, away in lines if not kept]
    return f"Farther off: {', '.join(missed)}." if missed else ""


# ---- as a picture ------------------------------------------------------------------------------------------


def draw(series: NewtonSeries) -> "Figure":
    """Draw the colours over thickness and path, with the orders, Newton's names, and the luminance."""
    drawn = figure(4.4)
    colours = drawn.add_axes((0.075, 0.46, 0.9, 0.31))
    luminance = drawn.add_axes((0.075, 0.125, 0.9, 0.2))
    _draw_colours(colours, series)
    _draw_luminance(luminance, series)
    drawn.suptitle("A soap film in air, D65, normal incidence", x=0.02, y=0.975, ha="left", **_TITLE)
    return drawn


_TITLE = {"size": 11, "weight": "bold", "color": INK}


def _draw_colours(axes: "Axes", series: NewtonSeries) -> None:
    first, last = series.thickness_nm[[0, -1]]
    strip(axes, shown(series.rgb, float(series.rgb.max()))[None], first, last)
    _draw_names(axes, series.newtons_chart)
    for end in _ends(series)[1:]:
        axes.axvline(end / (2 * series.n), color="white", lw=1.1, ls=(0, (3, 2)))
    dress(axes, "", "thickness of the film, nm")


def _draw_names(axes: "Axes", chart: NamedChart) -> None:
    """Write Newton's names above the strip, none nearer to the one before than can be read."""
    place = -np.inf
    for colour, kept in zip(chart.colours, chart.kept, strict=True):
        place = max(colour.thickness_nm, place + APART_NM)
        axes.plot([colour.thickness_nm, place], [1, 1.07], color=INK, lw=0.8, clip_on=False)
        axes.text(
            *(place, 1.1), colour.name, rotation=55, size=7.2, color=INK, ha="left", va="bottom",
            rotation_mode="anchor", style="normal" if kept else "italic",
        )  # fmt: skip


def _ends(series: NewtonSeries) -> list[float]:
    """Return the paths between which the first four orders are."""
    return [0.0, *series.tint_paths_nm[: len(_ORDERS)]]


_ORDERS = ("first order", "second", "third", "fourth")


def _draw_luminance(axes: "Axes", series: NewtonSeries) -> None:
    axes.plot(series.path_nm, series.luminance, color=INK, lw=1.4)
    for known in TINTS_NM:
        axes.axvline(known, color=TINT, lw=1.1, ls=(0, (3, 2)))
        axes.text(known, 1.08, f"{known:.0f} nm", size=8, color=TINT, ha="center")
    for name, (begin, end) in zip(_ORDERS, pairwise(_ends(series)), strict=True):
        axes.text((begin + end) / 2, 0.1, name, size=8.5, color=FAINT, ha="center")
    axes.set_xlim(*series.path_nm[[0, -1]])
    axes.set_ylim(0, 1.05)
    axes.set_yticks([0, 1])
    dress(axes, "", r"path difference $2nd$, nm", "luminance,\nlargest = 1")


COMPARISON = Comparison(
    name="newton-series",
    title="Newton's series in a soap film",
    against="Michel-Lévy's sensitive tints, Newton 1704",
    measure=measure,
    headline=headline,
    numbers=numbers,
    draw=draw,
)
