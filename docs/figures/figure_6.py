"""Figure 6: teapots brushed around their axis, with films of three thicknesses and two roughnesses."""

from collections.abc import Iterator
from itertools import chain
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from figures import studio
from figures.brushed import FEW_BOUNCES, Brushed, colour_lines, lobe_lines, measured_file, panels
from figures.figure import Figure, Quality
from figures.meshes.mesh import write_ply
from figures.meshes.teapot import teapot
from figures.studio import Camera, Scene, SoftBox
from figures.tables import Tables

FloatArray = NDArray[np.float64]

ROWS = tuple(
    tuple(Brushed("paper/figure-6", thickness_nm, roughness) for thickness_nm in (300.0, 400.0, 500.0))
    for roughness in (0.1, 0.2)
)
STOPS = 1.2
CAMERA = Camera(origin=(0.5, -9.0, 4.0), target=(0.05, 0.0, 0.86), fov_deg=14.3, aspect=1.38)
LIGHTS = (
    SoftBox(222, 46, 26, 34, 9.0, edge_deg=6),
    SoftBox(110, 34, 20, 50, 7.0, edge_deg=6),
    SoftBox(350, 50, 60, 18, 5.0, edge_deg=8),
)


def render(tables: Tables, quality: Quality) -> dict[str, Image.Image]:
    """Render a teapot for each roughness and thickness."""

    def rendered(surface: Brushed) -> FloatArray:
        return studio.rendered(scene(tables, surface, quality.height), quality.samples)

    return {"figure-6": panels(ROWS, rendered, STOPS)}


def scene(tables: Tables, surface: Brushed, height: int) -> Scene:
    """Return one panel's scene."""
    bsdf = studio.measured(measured_file(tables, surface.spec))
    pot = {"type": "ply", "filename": str(teapot_file(tables.folder)), "bsdf": bsdf}
    objects = {"teapot": pot, "floor": studio.plain(0.06)} | FEW_BOUNCES
    return studio.scene(studio.room(LIGHTS), CAMERA, height, objects)


def teapot_file(folder: Path) -> Path:
    """Return the mesh as a file, which is written if it is not there."""
    file = folder / "teapot.ply"
    return file if file.is_file() else write_ply(teapot(), file)


def findings(tables: Tables) -> Iterator[str]:
    """Return the colours of the films, and how wide the lobes are along the brush and across it."""
    surfaces = tuple(chain.from_iterable(ROWS))
    yield from colour_lines(surfaces)
    yield ""
    yield from lobe_lines(tables, surfaces)


FIGURE = Figure(
    number=6,
    caption="Interference renderings of teapots with the different surface roughnesses and thin film "
    "thicknesses.",
    quality=Quality(height=348, samples=64),
    render=render,
    findings=findings,
)
