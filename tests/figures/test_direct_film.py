"""A coated sphere in Mitsuba from our table, against a rendering that evaluates the film at each path."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import nacreous
from figures import studio
from figures.coated_glass import CAMERA, GLASS_CENTRE, LIGHTS, spheres
from figures.tables import MITSUBA_RANGE, Tables
from mitsuba_plugin import use_variant

HEIGHT, SAMPLES = 96, 64
LARGEST_MEAN_ERROR = 0.005

FILMS: dict[str, tuple[complex, complex, float]] = {
    "glass": (2.0, 1.5, 420.0),
    "opaque": (2.0, 1.5 + 0.01j, 420.0),
    "titanium": (2.5 + 0.01j, 2.7 + 3.5j, 45.0),
}
"""Indices of film and substrate, and thickness in nm: R and T of figure 3, R alone, and one that absorbs."""


def stack(index: complex, substrate: complex, thickness_nm: float) -> dict[str, Any]:
    """Return a spec's stack of one film in vacuum."""
    film, below = ({"n": each.real, "k": each.imag} for each in map(complex, (index, substrate)))
    return {
        "incident": "vacuum",
        "substrate": below,
        "layers": [{"material": film, "thickness_nm": thickness_nm}],
    }


@pytest.mark.parametrize("name", FILMS)
def test_a_coated_sphere_from_the_table_is_the_film_evaluated_at_each_wavelength(
    name: str, tmp_path: Path
) -> None:
    """Same seeds, same paths: pixels on the sphere differ by less than 0.5 % on average."""
    use_variant(studio.VARIANT)
    import direct_film

    spec = nacreous.Spec.from_document({"stack": stack(*FILMS[name])}, (MITSUBA_RANGE, "table.cos_theta=512"))
    file = Tables(tmp_path).written(spec, ".spectral.exr")
    direct_film.register(f"direct-{name}", direct_film.SingleFilm(*FILMS[name]))
    direct = {"type": f"direct-{name}", "filename": str(file)}
    expected, got = (studio.rendered(scene_with(each), SAMPLES) for each in (direct, studio.film(file)))
    error = np.abs(got - expected).mean(axis=2) / expected.mean(axis=2)
    assert error[coated_pixels()].mean() <= LARGEST_MEAN_ERROR


def scene_with(bsdf: dict[str, Any]) -> dict[str, Any]:
    """Return the scene of figure 3 with a BSDF on the sphere on the right."""
    return studio.scene(studio.room(LIGHTS), CAMERA, HEIGHT, spheres(bsdf))


def coated_pixels() -> np.ndarray:
    """Return which pixels see the coated sphere, (H, W): what a ray through their middle meets."""
    import mitsuba as mi

    width = round(HEIGHT * CAMERA.aspect)
    x, y = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(HEIGHT) + 0.5) / HEIGHT)
    scene = mi.load_dict(scene_with({"type": "diffuse"}))
    place = mi.Point2f(np.stack([x.ravel(), y.ravel()]).astype(np.float32))
    ray, _ = scene.sensors()[0].sample_ray(0, 0.5, place, mi.Point2f(0.5))
    met = np.array(scene.ray_intersect(ray).p, np.float64).T
    distance = np.linalg.norm(met - np.array(GLASS_CENTRE), axis=1)
    return (distance < 1.001).reshape(HEIGHT, width)
