"""Figure 8: Morpho wings with ridges of 80, 100, 120 and 135 nm, in one light and one direction of view."""

from collections.abc import Iterator
from shutil import copyfile

import numpy as np
from numpy.typing import NDArray
from PIL import Image

import nacreous
from figures import studio
from figures.butterflies import View, captioned, row_scene
from figures.figure import Figure, Quality
from figures.gamut import whitened
from figures.hue import Lab, lab, nearest_word
from figures.pictures import exposed, fitting_stops, stacked
from figures.ridges import ANGLES_DEG, OTHERS, PAPER, PRESET, THICKNESSES_NM, WORDS
from figures.tables import MITSUBA_RANGE, Tables
from figures.wing_chart import wing_chart

FloatArray = NDArray[np.float64]

VIEW = View(light_deg=26.0, camera_deg=26.0)
"""The stated geometry: the light 26 degrees from the vertical on one side, the view on the other."""
OTHER_VIEWS = (View(8.0, 8.0), View(40.0, 40.0))
"""Closer to normal incidence, where 135 nm is closest to red; and flatter, where 100 nm is bluer."""
BEST_DEG = (0.0, 35.0, 0.0, 0.0)
"""Angles at the facets at which each wing comes closest to its word: 100 nm is seen obliquely."""
ALPHA = 0.3
"""Of the wings' facets: assumed; hues do not depend on it."""


def render(tables: Tables, quality: Quality) -> dict[str, Image.Image]:
    """Render the four butterflies, and the chart of their colours over the angle under them."""
    views = sorted((VIEW, *OTHER_VIEWS), key=lambda view: view.facet_deg)
    rows = [captioned(_shown(rendering(tables, view, quality)), _caption(view)) for view in views]
    marked = [view.facet_deg for view in views]
    chart = wing_chart(THICKNESSES_NM, ANGLES_DEG, PAPER.colours, marked, rows[0].width)
    return {"figure-8": stacked([*rows, chart])}


def _shown(linear: FloatArray) -> Image.Image:
    in_gamut = whitened(linear)
    return exposed(in_gamut, fitting_stops(in_gamut))


def _caption(view: View) -> str:
    ridges = "Ridges of 80, 100, 120 and 135 nm"
    return f"{ridges}: light and view at {view.facet_deg:g}° on either side of the vertical"


def rendering(tables: Tables, view: View, quality: Quality) -> FloatArray:
    """Render the four in a row, linear (H, W, 3)."""
    films = [wing_film(tables, each) for each in THICKNESSES_NM]
    return studio.rendered(row_scene(tables.folder, films, view, quality.height), quality.samples)


def wing_film(tables: Tables, thickness_nm: float) -> studio.Scene:
    """Return the film on black, as on a scale whose melanin takes what the ridges let through."""
    file = tables.written(nacreous.preset(PRESET, (MITSUBA_RANGE,)), ".spectral.exr")
    opaque = file.with_name(f"opaque-{file.name}")  # where no file of T lies beside it
    if not opaque.is_file():
        copyfile(file, opaque)
    mean = nacreous.preset(PRESET).stack.layers[0].layers[0].thickness_nm
    return studio.film(opaque, alpha=ALPHA, thickness_scale=thickness_nm / mean)


def findings(_: Tables) -> Iterator[str]:
    """Return the exact hues in the stated geometry, at normal incidence, and where each word holds."""
    yield f"| ridge | the paper says | at {VIEW.facet_deg:g}°, as rendered | at 0° | the paper's word holds |"
    yield "|--:|---|---|---|---|"
    for thickness, word in zip(THICKNESSES_NM, WORDS, strict=True):
        seen = [lab(colour) for colour in PAPER.colours(thickness, ANGLES_DEG)]
        stated = seen[int(np.searchsorted(ANGLES_DEG, VIEW.facet_deg))]
        yield f"| {thickness:.0f} nm | {word} | {stated} | {seen[0]} | {_where(seen, word)} |"
    yield ""
    yield _nearest()
    held = PAPER.words_held()
    most = ANGLES_DEG[held == held.max()].astype(int)
    yield f"Words that hold at once, at most: {held.max()}, at {most[0]}° to {most[-1]}°."
    others = max(structure.words_held().max() for structure in OTHERS)
    yield f"With 1 to 12 pairs, or with one gap of 60 to 200 nm for all four wings: {others}."


def _nearest() -> str:
    """Say which of the paper's words each wing is nearest to in a direction of its own."""
    parts = []
    for thickness, angle in zip(THICKNESSES_NM, BEST_DEG, strict=True):
        hue = lab(PAPER.colours(thickness, np.array([angle, 90.0]))[0]).hue_deg
        parts.append(f"{thickness:.0f} nm at {angle:g}° is {hue:.0f}°, nearest to {nearest_word(hue, WORDS)}")
    return f"Each wing in a direction of its own, of the paper's four words: {'; '.join(parts)}.\n"


def _where(seen: list[Lab], word: str) -> str:
    """Return the angles at which a word holds, whole degrees."""
    holds = ANGLES_DEG[[colour.word == word for colour in seen]].astype(int)
    if not len(holds):
        return "at no angle"
    runs = np.split(holds, np.flatnonzero(np.diff(holds) > 1) + 1)
    return "from " + ", ".join(f"{run[0]}° to {run[-1]}°" for run in runs)


FIGURE = Figure(
    number=8,
    caption="Rendered biological iridescences of Morpho butterflies consisting of tree-like ridge structures "
    "with cuticle films of different thicknesses (left to right: 80 nm, 100 nm, 120 nm and 135 nm).",
    quality=Quality(height=264, samples=64),
    render=render,
    findings=findings,
)
