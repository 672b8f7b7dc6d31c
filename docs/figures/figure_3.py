"""Figure 3: a mirror sphere beside a glass sphere with a film of 420 nm."""

from collections.abc import Iterator

from PIL import Image

import nacreous
from figures.coated_glass import rendering
from figures.direct_comparison import comparison_lines
from figures.figure import Figure, Quality
from figures.interference import colour_lines
from figures.pictures import exposed, labelled
from figures.tables import Tables

PRESET = "paper/figure-3"
LABEL = "Mirror · glass with a film of 420 nm, n 2.0 on 1.5"
STOPS = 0.3
COMPARISON = Quality(height=96, samples=64)
"""Of the renderings that are compared: noise cancels between them."""


def render(tables: Tables, quality: Quality) -> dict[str, Image.Image]:
    """Render both spheres."""
    return {"figure-3": labelled(exposed(rendering(tables, PRESET, quality), STOPS), LABEL)}


def findings(tables: Tables) -> Iterator[str]:
    """Return the exact colours of the film, and how closely a rendering from its table follows it."""
    yield "Light that the film reflects once, exactly:"
    yield ""
    yield from colour_lines({"420 nm": nacreous.preset(PRESET)})
    yield ""
    yield (
        "The rendering, from a table of 512 cosines and 95 wavelengths, against one in which the film is "
        f"evaluated at each wavelength of each path; same seeds, {COMPARISON.samples} paths through each of "
        f"the pixels that see the coated sphere, {COMPARISON.height} pixels high:"
    )
    yield ""
    yield from comparison_lines(tables, COMPARISON)


FIGURE = Figure(
    number=3,
    caption=(
        "Renderings from a mirror sphere with perfect specular reflection (left) and a glass sphere coated "
        "with the 420 nm dielectric film (right)."
    ),
    quality=Quality(height=690, samples=144),
    render=render,
    findings=findings,
)
