"""Figure 3: a mirror sphere beside a glass sphere with a film of 420 nm."""

from collections.abc import Iterator

from PIL import Image

from figures.coated_glass import rendering
from figures.figure import Figure, Quality
from figures.interference import colour_lines
from figures.pictures import exposed, labelled
from figures.tables import Tables

PRESET = "paper/figure-3"
LABEL = "Mirror · glass with a film of 420 nm, n 2.0 on 1.5"
STOPS = 0.3


def render(tables: Tables, quality: Quality) -> dict[str, Image.Image]:
    """Render both spheres."""
    return {"figure-3": labelled(exposed(rendering(tables, PRESET, quality), STOPS), LABEL)}


def findings(_: Tables) -> Iterator[str]:
    """Return the exact colours of the film."""
    yield from colour_lines(PRESET)


FIGURE = Figure(
    number=3,
    caption=(
        "Renderings from a mirror sphere with perfect specular reflection (left) and a glass sphere coated "
        "with the 420 nm dielectric film (right)."
    ),
    quality=Quality(height=720, samples=256),
    render=render,
    findings=findings,
)
