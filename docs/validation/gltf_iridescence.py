"""glTF's thin film, KHR_materials_iridescence, against the exact film.

The formula is that of the Khronos extension, after L. Belcour and P. Barla, A Practical Extension to
Microfacet Theory for the Modeling of Varying Iridescence, ACM Trans. Graph. 36(4) (2017). Colours under D65
are compared by CIEDE2000, once with the film's own index and thickness, as a reader of the extension would
write them, and once with the parameters that Nacreous fits for `.gltf` files.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from nacreous.optics.iridescence import Iridescence, iridescent_reflectance
from nacreous.tables.fit.gltf import fit_gltf, naive_film
from nacreous.tables.fit.target import FitTarget
from nacreous.tables.spec import Spec
from validation.appearance import colour_difference, shown
from validation.comparison import Comparison
from validation.drawing import FAINT, INK, figure, strip
from validation.film_colours import colours_over_angle
from validation.page import table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

STATED_DEG = (0, 45, 70)
ANGLES_DEG = np.arange(0.0, 76.0)
"""In steps of one degree; beyond them every film turns white."""
ALIKE = 5.0
"""CIEDE2000 below which two colours side by side are told apart only when looked for."""


@dataclass(frozen=True)
class CoatedBase:
    """A film on a base, as the page calls it, and as a spec's stack has it."""

    label: str
    layer: Any
    thickness_nm: float
    base: Any

    @property
    def stack(self) -> Mapping[str, Any]:
        """Return the stack of a spec, in air."""
        layer = {"material": self.layer, "thickness_nm": self.thickness_nm}
        return {"incident": "air", "substrate": self.base, "layers": [layer]}


FILMS = (
    CoatedBase("soap film, 300 nm", "soap-water", 300.0, "air"),
    CoatedBase("MgF₂ 100 nm on glass", "magnesium-fluoride", 100.0, "bk7"),
    CoatedBase("n = 2.0, 420 nm on glass", {"n": 2.0}, 420.0, {"n": 1.5}),
    CoatedBase("TiO₂ (n = 2.4) 150 nm on glass", {"n": 2.4}, 150.0, {"n": 1.5}),
    CoatedBase("SiO₂ 300 nm on silicon", "thermal-oxide", 300.0, "silicon"),
    CoatedBase("SiO₂ 120 nm on silicon", "thermal-oxide", 120.0, "silicon"),
    CoatedBase("SiO₂ 300 nm on aluminium", "thermal-oxide", 300.0, "aluminium"),
    CoatedBase("TiO₂ (n = 2.4) 60 nm on titanium", {"n": 2.4}, 60.0, "titanium"),
    CoatedBase("TiO₂ (n = 2.4) 140 nm on titanium", {"n": 2.4}, 140.0, "titanium"),
)


@dataclass(frozen=True, eq=False)
class Compared:
    """Linear colours over `ANGLES_DEG`, (A, 3): of the film, of the formula, of the fitted formula."""

    film: CoatedBase
    exact: FloatArray
    formula: FloatArray
    fitted: FloatArray

    def apart(self, model: FloatArray) -> FloatArray:
        """Return CIEDE2000 of a model at the stated angles."""
        return colour_difference(model, self.exact)[list(STATED_DEG)]


def measure() -> list[Compared]:
    """Compute all films."""
    return [_compared(film) for film in FILMS]


def _compared(film: CoatedBase) -> Compared:
    stack = Spec.from_document({"stack": film.stack}).stack
    exact = colours_over_angle(film.stack, ANGLES_DEG)
    target = FitTarget(np.cos(np.radians(ANGLES_DEG[::-1])), exact[::-1])
    fitted = fit_gltf(target, stack).film
    return Compared(film, exact, _over_angle(naive_film(stack)), _over_angle(fitted))


def _over_angle(film: Iridescence) -> FloatArray:
    return iridescent_reflectance(film, np.cos(np.radians(ANGLES_DEG)))


def headline(films: list[Compared]) -> str:
    """Say how many films the formula shows rightly, and how wrong it is at worst."""
    alike = sum(each.apart(each.formula)[:2].max() < ALIKE for each in films)
    worst = max(each.apart(each.formula).max() for each in films)
    worst_fitted = max(each.apart(each.fitted).max() for each in films)
    return (
        f"{alike} of {len(films)} films within CIEDE2000 {ALIKE:.0f} at 0° and 45°; the worst is off by "
        f"{worst:.0f}, with fitted parameters by {worst_fitted:.0f}"
    )


def numbers(films: list[Compared]) -> str:
    """Say how far apart the colours are."""
    angles = " | ".join(f"{angle}°:" for angle in STATED_DEG)
    header = f"film, CIEDE2000 at | {angles} | {angles.replace('°', '°, fitted')}"
    rows = [" | ".join([each.film.label, *_cells(each)]) for each in films]
    return f"**{headline(films)}.**\n\n{table(header, rows)}"


def _cells(film: Compared) -> list[str]:
    both = np.concatenate([film.apart(film.formula), film.apart(film.fitted)])
    return [f"{apart:.1f}" for apart in both]


# ---- as a picture ------------------------------------------------------------------------------------------


def draw(films: list[Compared]) -> "Figure":
    """Draw a pair of strips for each film, exact above formula, over the angle."""
    drawn = figure(0.58 * len(films) + 1.05)
    inch = 1 / drawn.get_figheight()
    grid = drawn.subplots(len(films), 1, sharex=True)
    drawn.subplots_adjust(left=0.3, right=0.82, top=1 - 0.62 * inch, bottom=0.5 * inch, hspace=0.22)
    drawn.suptitle("Exact film above, glTF's formula below", **_TITLE)
    for axes, each in zip(grid, films, strict=True):
        _draw_pair(axes, each)
    _draw_row(grid[0], 1.3, [f"{angle}°" for angle in STATED_DEG], FAINT)
    drawn.text(0.98, 0.985, "CIEDE2000 at", size=8.5, color=FAINT, ha="right", va="top")
    grid[-1].tick_params(colors=INK, labelsize=8.5)
    grid[-1].set_xticks(range(0, 76, 15))
    grid[-1].set_xlabel("angle of incidence, degrees", color=INK, size=9)
    return drawn


_TITLE: dict[str, Any] = {"x": 0.02, "y": 0.985, "ha": "left", "size": 11, "weight": "bold", "color": INK}


def _draw_pair(axes: "Axes", each: Compared) -> None:
    white = float(max(each.exact.max(), each.formula.max()))
    strip(axes, np.stack([shown(each.exact, white), shown(each.formula, white)]), *ANGLES_DEG[[0, -1]])
    axes.axhline(0.5, color="white", lw=0.8)
    axes.spines["bottom"].set_visible(False)
    axes.tick_params(bottom=False)
    axes.text(-0.02, 0.5, each.film.label, ha="right", va="center", transform=axes.transAxes, **_LABEL)
    _draw_row(axes, 0.5, [f"{value:.1f}" for value in each.apart(each.formula)], INK)


_LABEL: dict[str, Any] = {"size": 8.5, "color": INK}


def _draw_row(axes: "Axes", height: float, cells: list[str], colour: str) -> None:
    """Write a line of the table on the right of the strips."""
    for place, cell in zip((1.1, 1.21, 1.32), cells, strict=True):
        axes.text(
            place, height, cell, size=8.5, color=colour, ha="right", va="center", transform=axes.transAxes
        )


COMPARISON = Comparison(
    name="gltf-iridescence",
    title="glTF's iridescence",
    against="the formula of KHR_materials_iridescence",
    measure=measure,
    headline=headline,
    numbers=numbers,
    draw=draw,
)
