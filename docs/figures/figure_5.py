"""Figure 5: opaque objects with films of 400 and 600 nm under Blinn's lobe, by Mitsuba's own `measured`."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from PIL import Image

import nacreous
from figures import studio
from figures.figure import Figure, Quality
from figures.interference import colour_lines
from figures.pictures import exposed, labelled, side_by_side
from figures.studio import Camera, SoftBox
from figures.tables import MITSUBA_RANGE, Tables
from figures.torus_knot import torus_knot
from nacreous import Spec

FloatArray = NDArray[np.float64]

PRESET = "paper/figure-5"
THICKNESSES_NM = (400.0, 600.0)
STOPS = 0.8
CAMERA = Camera(origin=(0.15, -10.5, 4.0), target=(0.12, 0.0, 0.92), fov_deg=15.2, aspect=1.15)
LIGHTS = (
    SoftBox(180, 58, 130, 50, 2.6, edge_deg=8),
    SoftBox(265, 30, 50, 56, 3.6, edge_deg=8),
    SoftBox(80, 30, 36, 60, 3.6, edge_deg=8),
    SoftBox(0, 34, 140, 20, 2.6, edge_deg=8),
)


def surface_spec(thickness_nm: float) -> Spec:
    """Return the preset's stack and surface as a bsdf of one thickness."""
    given = nacreous.preset(PRESET, (f"stack.layers.0.thickness_nm={thickness_nm}",))
    document = given.model_dump(include={"stack", "surface"}, exclude_unset=True)
    return Spec.from_document({**document, "table": {"quantity": "bsdf"}}, (MITSUBA_RANGE,))


def render(tables: Tables, quality: Quality) -> dict[str, Image.Image]:
    """Render a knot and a sphere for each thickness."""
    panels = [
        labelled(exposed(rendering(tables, each, quality), STOPS), f"Opaque, film of {each:.0f} nm")
        for each in THICKNESSES_NM
    ]
    return {"figure-5": side_by_side(panels)}


def rendering(tables: Tables, thickness_nm: float, quality: Quality) -> FloatArray:
    """Render both objects with one film, linear (H, W, 3)."""
    bsdf = studio.measured(tables.written(surface_spec(thickness_nm), ".bsdf"))
    objects = {
        "sphere": {"type": "sphere", "center": [1.08, -0.7, 0.58], "radius": 0.58, "bsdf": bsdf},
        "knot": torus_knot(bsdf),
        "floor": studio.plain(0.08),
    }
    scene = studio.scene(studio.room(LIGHTS), CAMERA, quality.height, objects)
    return studio.rendered(scene, quality.samples)


def findings(_: Tables) -> Iterator[str]:
    """Return the exact colours of both films on a smooth surface."""
    yield "Light that each film reflects once, on a facet that it meets at this angle, exactly:"
    yield ""
    yield from colour_lines({f"{each:.0f} nm": surface_spec(each) for each in THICKNESSES_NM})


FIGURE = Figure(
    number=5,
    caption="Interference renderings of opaque objects coated with 400 nm and 600 nm dielectric films "
    "respectively.",
    quality=Quality(height=640, samples=64),
    render=render,
    findings=findings,
)
