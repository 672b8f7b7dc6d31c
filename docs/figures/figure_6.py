"""Figure 6: brushed teapots of several roughnesses, with films of several thicknesses."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from figures import studio
from figures.brushed import Grid, brushed_spec, measured_file, panels
from figures.figure import Figure, Quality
from figures.meshes.mesh import write_ply
from figures.meshes.teapot import teapot
from figures.studio import Camera, Scene, SoftBox
from figures.tables import Tables

FloatArray = NDArray[np.float64]

GRID = Grid("paper/figure-6", roughnesses=(0.1, 0.2), thicknesses_nm=(300.0, 400.0, 500.0))
STOPS = 0.8
CAMERA = Camera(origin=(0.5, -9.0, 4.0), target=(0.03, 0.0, 0.83), fov_deg=13.5, aspect=1.4)
LIGHTS = (
    SoftBox(222, 46, 26, 34, 9.0, edge_deg=6),
    SoftBox(110, 34, 20, 50, 7.0, edge_deg=6),
    SoftBox(350, 50, 60, 18, 5.0, edge_deg=8),
)


def render(tables: Tables, quality: Quality) -> dict[str, Image.Image]:
    """Render a teapot for each roughness and thickness."""

    def rendered(thickness_nm: float, roughness: float) -> FloatArray:
        return studio.rendered(scene(tables, thickness_nm, roughness, quality.height), quality.samples)

    return {"figure-6": panels(GRID, rendered, STOPS)}


def scene(tables: Tables, thickness_nm: float, roughness: float, height: int) -> Scene:
    """Return one panel's scene."""
    spec = brushed_spec(GRID.preset, thickness_nm, roughness)
    file = measured_file(tables, spec, f"teapot-{thickness_nm:g}-{roughness:g}")
    pot = {"type": "ply", "filename": str(teapot_file(tables.folder)), "bsdf": studio.measured(file)}
    return studio.scene(
        studio.room(LIGHTS), CAMERA, height, {"teapot": pot, "floor": studio.plain(0.08)}
    )


def teapot_file(folder: Path) -> Path:
    """Return the mesh as a file, which is written if it is not there."""
    file = folder / "teapot.ply"
    return file if file.is_file() else write_ply(teapot(), file)


def findings(_: Tables) -> Iterator[str]:
    """Return what was measured."""
    yield ""


FIGURE = Figure(
    number=6,
    caption="Interference renderings of teapots with the different surface roughnesses and thin film "
    "thicknesses.",
    quality=Quality(height=360, samples=128),
    render=render,
    findings=findings,
)
