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
from figures.studio import Camera, SoftBox, Walls
from figures.tables import MITSUBA_RANGE, Tables

FloatArray = NDArray[np.float64]

CAMERA = Camera(origin=(0.0, -10.5, 2.5), target=(0.0, 0.0, 0.97), fov_deg=14.4, aspect=1.8)
MIRROR_CENTRE = (-1.1, 0.45, 1.0)
GLASS_CENTRE = (1.08, -0.2, 1.0)
GLASS_RADIUS = 1.0
LIGHTS = (
    SoftBox(214, 50, 52, 52, 2.6),
    SoftBox(146, 50, 52, 52, 2.6),
    SoftBox(270, 34, 40, 64, 2.6),
    SoftBox(90, 34, 40, 64, 2.6),
    SoftBox(180, 8, 60, 22, 1.8),
    SoftBox(0, 50, 110, 24, 1.5),
)
WALLS = Walls(below=(0.01, 0.01, 0.01), horizon=(0.05, 0.055, 0.065), zenith=(0.02, 0.02, 0.02))
ROD_COLOURS = ((0.80, 0.74, 0.62), (0.50, 0.17, 0.07), (0.07, 0.16, 0.26))
TABLE_SUFFIX = ".spectral.exr"
TABLE_AXES = (MITSUBA_RANGE, "table.cos_theta=512")


def film_file(tables: Tables, preset: str) -> Path:
    """Return R of a preset of the paper, with T beside it."""
    spec = nacreous.preset(preset, TABLE_AXES)
    return tables.written(spec, TABLE_SUFFIX)


def rendering(tables: Tables, preset: str, quality: Quality) -> FloatArray:
    """Render both spheres, linear (H, W, 3)."""
    light = studio.room(LIGHTS, WALLS)
    glass = studio.film(film_file(tables, preset))
    return studio.rendered(studio.scene(light, CAMERA, quality.height, spheres(glass)), quality.samples)


def spheres(glass: dict[str, Any]) -> dict[str, Any]:
    """Return the objects, with the BSDF of the sphere on the right."""
    return {
        "mirror": {"type": "sphere", "center": list(MIRROR_CENTRE), "bsdf": {"type": "conductor"}},
        "glass": {"type": "sphere", "center": list(GLASS_CENTRE), "radius": GLASS_RADIUS, "bsdf": glass},
        "floor": studio.chequered(dark=0.025, light=0.14, square=1.6, turn_deg=28),
    } | rods()


def rods() -> dict[str, Any]:
    """Return a fence of rods behind the spheres: what glass turns upside down."""
    return {
        f"rod-{at}": {
            "type": "cylinder",
            "p0": [x, 5.0, 0],
            "p1": [x, 5.0, 1.2 + 0.3 * (at % 2)],
            "radius": 0.16,
            "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": list(colour)}},
        }
        for at, x in enumerate(np.linspace(-5.6, 5.6, 15).tolist())
        for colour in [ROD_COLOURS[at % len(ROD_COLOURS)]]
    }
