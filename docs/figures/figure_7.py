"""Figure 7: kangaroos brushed upwards, with the two films of figure 5 and three roughnesses."""

from PIL import Image

from figures.brushed import Brushed
from figures.brushed_object import BrushedObject
from figures.figure import Figure, Quality
from figures.meshes.kangaroo import kangaroo
from figures.studio import Camera, SoftBox
from figures.tables import Tables

KANGAROO = BrushedObject(
    name="kangaroo",
    mesh=kangaroo,
    rows=tuple(
        tuple(Brushed("paper/figure-7", thickness_nm, roughness) for roughness in (0.05, 0.1, 0.2))
        for thickness_nm in (400.0, 600.0)
    ),
    camera=Camera(origin=(3.6, -10.0, 3.0), target=(-0.40, 0.0, 0.97), fov_deg=11.6, aspect=1.1),
    lights=(
        SoftBox(215, 42, 40, 40, 6.0, edge_deg=8),
        SoftBox(110, 36, 26, 60, 6.0, edge_deg=8),
        SoftBox(290, 30, 24, 60, 5.0, edge_deg=8),
        SoftBox(350, 55, 80, 22, 5.0, edge_deg=8),
    ),
    stops=1.0,
)


def render(tables: Tables, quality: Quality) -> dict[str, Image.Image]:
    """Render a kangaroo for each roughness and thickness."""
    return {"figure-7": KANGAROO.picture(tables, quality)}


FIGURE = Figure(
    number=7,
    caption="Interference renderings of kangaroos with the different surface roughnesses and thin film "
    "thicknesses.",
    quality=Quality(height=430, samples=64),
    render=render,
    findings=KANGAROO.findings,
)
