"""The scene of figures 3 and 4: a mirror sphere beside a glass sphere with a film, rods behind both.

The film reflects and transmits: light enters the glass through it and leaves through it again.
"""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import nacreous
from figures import studio
from figures.figure import Quality
from figures.studio import Camera, SoftBox
from figures.tables import MITSUBA_RANGE, Tables

FloatArray = NDArray[np.float64]

CAMERA = Camera(origin=(0.0, -10.5, 2.9), target=(0.02, 0.0, 0.96), fov_deg=15.5, aspect=1.75)
MIRROR_CENTRE = (-1.16, 0.35, 1.0)
GLASS_CENTRE = (1.12, -0.25, 1.0)
GLASS_RADIUS = 1.0
LIGHTS = (
    SoftBox(180, 62, 150, 50, 1.6),
    SoftBox(262, 28, 38, 50, 2.6),
    SoftBox(82, 30, 26, 56, 2.6),
    SoftBox(180, 12, 44, 26, 1.2),
    SoftBox(0, 40, 120, 14, 1.4),
)
ROD_COLOURS = ((0.85, 0.83, 0.78), (0.55, 0.16, 0.07), (0.85, 0.83, 0.78), (0.08, 0.10, 0.14))
TABLE_SUFFIX = ".spectral.exr"
TABLE_AXES = (MITSUBA_RANGE, "table.cos_theta=512")


def film_file(tables: Tables, preset: str) -> Path:
    """Return R of a preset of the paper, with T beside it."""
    spec = nacreous.preset(preset, TABLE_AXES)
    return tables.written(spec, TABLE_SUFFIX)


def rendering(tables: Tables, preset: str, quality: Quality) -> FloatArray:
    """Render both spheres, linear (H, W, 3)."""
    light = studio.room(LIGHTS)
    glass = studio.film(film_file(tables, preset))
    return studio.rendered(studio.scene(light, CAMERA, quality.height, spheres(glass)), quality.samples)


def spheres(glass: dict[str, Any]) -> dict[str, Any]:
    """Return the objects, with the BSDF of the sphere on the right."""
    return {
        "mirror": {"type": "sphere", "center": list(MIRROR_CENTRE), "bsdf": {"type": "conductor"}},
        "glass": {"type": "sphere", "center": list(GLASS_CENTRE), "radius": GLASS_RADIUS, "bsdf": glass},
        "floor": studio.chequered(dark=0.06, light=0.30, square=0.9),
    } | rods()


def rods() -> dict[str, Any]:
    """Return a fence of rods behind the spheres: what glass turns upside down."""
    return {
        f"rod-{at}": {
            "type": "cylinder",
            "p0": [x, 4.5, 0],
            "p1": [x, 4.5, 2.0 + 0.35 * (at % 3)],
            "radius": 0.16,
            "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": list(colour)}},
        }
        for at, x in enumerate(np.linspace(-5.6, 5.6, 15).tolist())
        for colour in [ROD_COLOURS[at % len(ROD_COLOURS)]]
    }
