"""Figure 4: the scene of figure 3 with a film of 450 nm, and both films' colours over the angle."""

from collections.abc import Iterator

from PIL import Image

import nacreous
from figures.coated_glass import rendering
from figures.figure import Figure, Quality
from figures.film_chart import ShownFilm, film_chart
from figures.interference import STATED_ANGLES_DEG, colour_lines, maxima_lines, share_of_red
from figures.pictures import exposed, labelled
from figures.tables import Tables

PRESET = "paper/figure-4"
LABEL = "Mirror · glass with a film of 450 nm, n 2.0 on 1.5"
STOPS = 0.3
INDEX = 2.0
FILMS = (
    ShownFilm("420 nm", "paper/figure-3", INDEX, 420.0),
    ShownFilm("450 nm", PRESET, INDEX, 450.0),
)


def render(tables: Tables, quality: Quality) -> dict[str, Image.Image]:
    """Render both spheres, and draw the films' colours."""
    picture = labelled(exposed(rendering(tables, PRESET, quality), STOPS), LABEL)
    return {"figure-4": picture, "figure-3-4-films": film_chart(FILMS)}


def findings(_: Tables) -> Iterator[str]:
    """Return both films' exact colours, and how the maxima and the colour move from figure 3 to 4."""
    yield from maxima_lines({film.label: (film.preset, film.thickness_nm) for film in FILMS}, INDEX)
    yield ""
    yield from colour_lines({film.label: nacreous.preset(film.preset) for film in FILMS})
    yield ""
    yield from shift_lines()


def shift_lines() -> Iterator[str]:
    """Tell which way the colour moves, as the share of red, where the paper says that it moves to red."""
    thin, thick = (share_of_red(nacreous.preset(film.preset), STATED_ANGLES_DEG) for film in FILMS)
    falling = ", ".join(f"{theta:.0f}°" for theta in STATED_ANGLES_DEG[thick < thin])
    rising = ", ".join(f"{theta:.0f}°" for theta in STATED_ANGLES_DEG[thick >= thin]) or "none of them"
    yield (
        "The share of red in the linear colour, R / (R + G + B), moves at normal incidence from "
        f"{thin[0]:.2f} to {thick[0]:.2f}. Of the angles above it falls at {falling}, and rises at {rising}."
    )


FIGURE = Figure(
    number=4,
    caption=(
        "Renderings from a mirror sphere coated with perfect specular reflection (left) and a glass sphere "
        "with the 450 nm dielectric film (right)."
    ),
    quality=Quality(height=690, samples=144),
    render=render,
    findings=findings,
)
