"""Figure 4: the scene of figure 3 with a film of 450 nm, and both films' colours over the angle."""

from collections.abc import Iterator

from PIL import Image

from figures.coated_glass import rendering
from figures.figure import Figure, Quality
from figures.film_chart import ShownFilm, film_chart
from figures.interference import colour_lines, maxima_lines
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
    """Return the film's exact colours, and how the maxima move from figure 3 to 4."""
    yield from colour_lines(PRESET)
    yield ""
    films = {film.label: (film.preset, film.thickness_nm) for film in FILMS}
    yield from maxima_lines(films, INDEX)


FIGURE = Figure(
    number=4,
    caption=(
        "Renderings from a mirror sphere coated with perfect specular reflection (left) and a glass sphere "
        "with the 450 nm dielectric film (right)."
    ),
    quality=Quality(height=720, samples=256),
    render=render,
    findings=findings,
)
