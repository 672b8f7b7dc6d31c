"""Figure 7: kangaroos brushed upwards, with the two films of figure 5 and three roughnesses."""

from collections.abc import Iterator
from itertools import chain
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from figures import studio
from figures.brushed import FEW_BOUNCES, Brushed, colour_lines, lobe_lines, measured_file, panels
from figures.figure import Figure, Quality
from figures.meshes.kangaroo import kangaroo
from figures.meshes.mesh import write_ply
from figures.studio import Camera, Scene, SoftBox
from figures.tables import Tables

FloatArray = NDArray[np.float64]

ROWS = tuple(
    tuple(Brushed("paper/figure-7", thickness_nm, roughness) for roughness in (0.05, 0.1, 0.2))
    for thickness_nm in (400.0, 600.0)
)
STOPS = 1.0
CAMERA = Camera(origin=(3.6, -10.0, 3.0), target=(-0.40, 0.0, 0.97), fov_deg=11.6, aspect=1.1)
LIGHTS = (
    SoftBox(215, 42, 40, 40, 6.0, edge_deg=8),
    SoftBox(110, 36, 26, 60, 6.0, edge_deg=8),
    SoftBox(290, 30, 24, 60, 5.0, edge_deg=8),
    SoftBox(350, 55, 80, 22, 5.0, edge_deg=8),
)


def render(tables: Tables, quality: Quality) -> dict[str, Image.Image]:
    """Render a kangaroo for each thickness and roughness."""

    def rendered(surface: Brushed) -> FloatArray:
        return studio.rendered(scene(tables, surface, quality.height), quality.samples)

    return {"figure-7": panels(ROWS, rendered, STOPS)}


def scene(tables: Tables, surface: Brushed, height: int) -> Scene:
    """Return one panel's scene."""
    bsdf = studio.measured(measured_file(tables, surface.spec))
    animal = {"type": "ply", "filename": str(kangaroo_file(tables.folder)), "bsdf": bsdf}
    objects = {"kangaroo": animal, "floor": studio.plain(0.06)} | FEW_BOUNCES
    return studio.scene(studio.room(LIGHTS), CAMERA, height, objects)


def kangaroo_file(folder: Path) -> Path:
    """Return the mesh as a file, which is written if it is not there."""
    file = folder / "kangaroo.ply"
    return file if file.is_file() else write_ply(kangaroo(), file)


def findings(tables: Tables) -> Iterator[str]:
    """Return the colours of the films, and how wide the lobes are across the brush and along it."""
    surfaces = tuple(chain.from_iterable(ROWS))
    yield from colour_lines(surfaces)
    yield ""
    yield from lobe_lines(tables, surfaces)


FIGURE = Figure(
    number=7,
    caption="Interference renderings of kangaroos with the different surface roughnesses and thin film "
    "thicknesses.",
    quality=Quality(height=430, samples=64),
    render=render,
    findings=findings,
)
