"""Figure 9: a wing with ridges of 90 nm under the Phong lobe of Sun 2006, and under the paper's facets."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image

import nacreous
from figures import studio
from figures.brushed import RANGE_NM
from figures.butterflies import View, captioned, row_scene
from figures.figure import Figure, Quality
from figures.gamut import whitened
from figures.hue import lab
from figures.lobe import lobe_of_file, shown_width
from figures.pictures import exposed, fitting_stops, stacked
from figures.tables import MITSUBA_RANGE, Tables, colours, table_at_angles
from nacreous import Spec

FloatArray = NDArray[np.float64]

PRESET = "paper/figure-9"
VIEWS = (View(26.0, 26.0), View(64.0, 16.0))
"""In the direction of the mirror, and far from it: the facets that reflect there lean by 24 degrees."""
STATED_DEG = np.array([0.0, 26.0, 40.0, 60.0])


@dataclass(frozen=True)
class Model:
    """A surface for the preset's stack."""

    name: str
    assignments: tuple[str, ...] = ()

    @property
    def spec(self) -> Spec:
        """Return the stack under this surface as a bsdf, of the reflected light alone."""
        given = nacreous.preset(PRESET, self.assignments)
        document = given.model_dump(include={"stack", "surface"}, exclude_unset=True)
        table = {"quantity": "bsdf", "wavelength_nm": RANGE_NM, "transmission": "discard"}
        return Spec.from_document(document | {"table": table})

    def reflected(self, cos_theta: FloatArray) -> FloatArray:
        """Return the colour of all light that is reflected, for light at these cosines: (A, 3)."""
        axis = f"table.cos_theta=[{', '.join(map(repr, cos_theta.tolist()))}]"
        table = nacreous.tabulate(nacreous.preset(PRESET, (*self.assignments, MITSUBA_RANGE, axis)))
        return np.asarray(table["E_r_rgb"], np.float64).reshape(-1, 3)


SUN = Model("Sun's Phong lobe, exponent 50")
ISOTROPIC = Model("Ashikhmin-Shirley, exponents 50 and 50", ("surface.distribution=ashikhmin-shirley",))
OURS = Model(
    "Ashikhmin-Shirley, exponents 200 and 11.4",
    ("surface.distribution=ashikhmin-shirley", "surface.exponent_x=200", "surface.exponent_y=11.4"),
)
"""Assumed; the product of both alphas is that of 50 and 50. Ridges run along x: facets lean along y."""


def render(tables: Tables, quality: Quality) -> dict[str, Image.Image]:
    """Render both wings in both views."""
    return {"figure-9": stacked([_row(tables, view, quality) for view in VIEWS])}


def _row(tables: Tables, view: View, quality: Quality) -> Image.Image:
    linear = whitened(rendering(tables, view, quality))
    return captioned(exposed(linear, fitting_stops(linear)), _caption(view))


def rendering(tables: Tables, view: View, quality: Quality) -> FloatArray:
    """Render Sun's wing on the left and ours on the right, linear (H, W, 3)."""
    films = [studio.measured(tables.written(model.spec, ".bsdf")) for model in (SUN, OURS)]
    return studio.rendered(row_scene(tables.folder, films, view, quality.height), quality.samples)


def _caption(view: View) -> str:
    where = f"light {view.light_deg:g}°, view {view.camera_deg:g}° from the vertical"
    return f"{SUN.name} (left), {OURS.name} (right); {where}"


def findings(tables: Tables) -> Iterator[str]:
    """Return the film's colours, which both models share, and each model's lobe and energy."""
    yield "| angle at the facets | " + " | ".join(f"{each:.0f}°" for each in STATED_DEG) + " |"
    yield "|---|" + "---|" * len(STATED_DEG)
    seen = colours(table_at_angles(SUN.spec, STATED_DEG))
    yield "| colour of either model | " + " | ".join(str(lab(colour)) for colour in seen) + " |"
    yield ""
    yield "| model | lobe along x, y | all that it reflects of light at 0° | at 60° |"
    yield "|---|---|---|---|"
    for model in (SUN, ISOTROPIC, OURS):
        yield _model_line(tables, model)


def _model_line(tables: Tables, model: Model) -> str:
    lobe = lobe_of_file(tables.written(model.spec, ".bsdf"))
    flat, normal = model.reflected(np.array([0.5, 1.0]))
    words = " | ".join(f"Y {_luminance(each):.3f}, {lab(each)}" for each in (normal, flat))
    return f"| {model.name} | {shown_width(lobe.x_deg)}, {shown_width(lobe.y_deg)} | {words} |"


def _luminance(rgb: FloatArray) -> float:
    return float(rgb @ [0.2126, 0.7152, 0.0722])


FIGURE = Figure(
    number=9,
    caption="Comparison of rendered biological iridescences of Morpho butterfly wings with 90nm cuticle "
    "layer thickness using Sun butterfly shader (Sun, 2006) (left) and our proposed multilayer interference "
    "model (right) respectively.",
    quality=Quality(height=430, samples=64),
    render=render,
    findings=findings,
)
