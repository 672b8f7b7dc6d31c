"""Figure 6: teapots brushed around their axis, with films of three thicknesses and two roughnesses."""

from PIL import Image

from figures.brushed import Brushed
from figures.brushed_object import BrushedObject
from figures.figure import Figure, Quality
from figures.meshes.teapot import teapot
from figures.studio import Camera, SoftBox
from figures.tables import Tables

TEAPOT = BrushedObject(
    name="teapot",
    mesh=teapot,
    rows=tuple(
        tuple(Brushed("paper/figure-6", thickness_nm, roughness) for thickness_nm in (300.0, 400.0, 500.0))
        for roughness in (0.1, 0.2)
    ),
    camera=Camera(origin=(0.5, -9.0, 4.0), target=(0.05, 0.0, 0.86), fov_deg=14.3, aspect=1.38),
    lights=(
        SoftBox(222, 46, 26, 34, 9.0, edge_deg=6),
        SoftBox(110, 34, 20, 50, 7.0, edge_deg=6),
        SoftBox(350, 50, 60, 18, 5.0, edge_deg=8),
    ),
    stops=1.2,
)


def render(tables: Tables, quality: Quality) -> dict[str, Image.Image]:
    """Render a teapot for each roughness and thickness."""
    return {"figure-6": TEAPOT.picture(tables, quality)}


FIGURE = Figure(
    number=6,
    caption="Interference renderings of teapots with the different surface roughnesses and thin film "
    "thicknesses.",
    quality=Quality(height=348, samples=64),
    render=render,
    findings=TEAPOT.findings,
)
