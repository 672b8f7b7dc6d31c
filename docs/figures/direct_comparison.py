"""The coated sphere of figure 3 from a table, against one whose film is evaluated on each path.

Both have the same seeds, so that their paths and wavelengths are the same, and noise cancels. What is left is
what the table's samples and their linear interpolation cost.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import nacreous
from figures import studio
from figures.coated_glass import (
    CAMERA,
    GLASS_CENTRE,
    GLASS_RADIUS,
    LIGHTS,
    TABLE_AXES,
    TABLE_SUFFIX,
    WALLS,
    spheres,
)
from figures.figure import Quality
from figures.tables import Tables

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class ComparedFilm:
    """A film in vacuum: its index and that of what it lies on, n + ik, and its thickness."""

    index: complex
    substrate: complex
    thickness_nm: float

    def spec(self) -> nacreous.Spec:
        """Return the spec, with the axes of the figure's table."""
        film, substrate = ({"n": each.real, "k": each.imag} for each in (self.index, self.substrate))
        layer = {"material": film, "thickness_nm": self.thickness_nm}
        stack = {"incident": "vacuum", "substrate": substrate, "layers": [layer]}
        return nacreous.Spec.from_document({"stack": stack}, TABLE_AXES)


FILMS = {
    "R and T: figure 3, 420 nm on glass": ComparedFilm(2.0 + 0j, 1.5 + 0j, 420.0),
    "R alone: the same on an opaque substrate, k 0.01": ComparedFilm(2.0 + 0j, 1.5 + 0.01j, 420.0),
    "absorbing: 45 nm of 2.5 + 0.01i on 2.7 + 3.5i, as oxide on titanium": ComparedFilm(
        2.5 + 0.01j, 2.7 + 3.5j, 45.0
    ),
}


def comparison_lines(tables: Tables, quality: Quality) -> Iterator[str]:
    """Return a Markdown table of the errors."""
    yield "| film | mean relative error of the pixels |"
    yield "|---|--:|"
    for name, film in FILMS.items():
        yield f"| {name} | {100 * mean_relative_error(film, tables, quality):.2f} % |"


def mean_relative_error(film: ComparedFilm, tables: Tables, quality: Quality) -> float:
    """Return the mean, over the pixels that see the coated sphere, of the relative error of R, G and B."""
    file = tables.written(film.spec(), TABLE_SUFFIX)
    direct = {"type": registered(film), "filename": str(file)}
    expected, got = (rendering(each, quality) for each in (direct, studio.film(file)))
    error = np.abs(got - expected).mean(axis=2) / expected.mean(axis=2)
    return float(error[coated_pixels(quality.height)].mean())


def registered(film: ComparedFilm) -> str:
    """Make the film, evaluated on each path, known to Mitsuba; return the name of its plugin."""
    import direct_film

    name = f"direct-{film.index}-{film.substrate}-{film.thickness_nm}"
    direct_film.register(name, direct_film.SingleFilm(film.index, film.substrate, film.thickness_nm))
    return name


def rendering(bsdf: dict[str, Any], quality: Quality) -> FloatArray:
    """Render the scene of figure 3 with a BSDF on the sphere on the right."""
    scene = studio.scene(studio.room(LIGHTS, WALLS), CAMERA, quality.height, spheres(bsdf))
    return studio.rendered(scene, quality.samples)


def coated_pixels(height: int) -> Mask:
    """Return which pixels see the coated sphere, (H, W): what a ray through their middle meets."""
    import mitsuba as mi

    width = round(height * CAMERA.aspect)
    x, y = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    scene = mi.load_dict(studio.scene(studio.room(()), CAMERA, height, spheres({"type": "diffuse"})))
    place = mi.Point2f(np.stack([x.ravel(), y.ravel()]).astype(np.float32))
    ray, _ = scene.sensors()[0].sample_ray(0, 0.5, place, mi.Point2f(0.5))
    met = np.array(scene.ray_intersect(ray).p, np.float64).T
    distance = np.linalg.norm(met - np.array(GLASS_CENTRE), axis=1)
    return (distance < 1.001 * GLASS_RADIUS).reshape(height, width)
