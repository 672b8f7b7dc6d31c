"""Butterflies in Mitsuba: iridescent wings with pigment, a dark body, one light and one direction of view.

The interference of a microfacet follows from the half of the angle between light and view alone, whatever the
slope of the wing and its facets. With the light and the camera far away that is one angle for all wings, and
each wing has one hue all over.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.font_manager import FontProperties, findfont
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from figures.meshes.mesh import write_ply
from figures.meshes.pigment import wing_pigment
from figures.meshes.wing import WINGS, Side, body, wing
from figures.pictures import INK, PAPER
from figures.studio import Scene

FloatArray = NDArray[np.float64]

SPACING = 3.05
"""Between the middles of butterflies, in units of the mesh: their span is 2.8."""
SIDES: tuple[Side, ...] = ("right", "left")
LIGHT_BREADTH_DEG = 3.0


@dataclass(frozen=True)
class View:
    """Light and camera, far away on either side of the vertical.

    Parameters
    ----------
    light_deg, camera_deg : float
        Their angles from the vertical, the light's towards the insect's head (+y), the camera's away from it.
    """

    light_deg: float
    camera_deg: float

    @property
    def facet_deg(self) -> float:
        """Angle of incidence on the facets that reflect the light to the camera."""
        return (self.light_deg + self.camera_deg) / 2

    @property
    def to_light(self) -> FloatArray:
        """Unit vector towards the light."""
        return _leaning(self.light_deg)

    @property
    def to_camera(self) -> FloatArray:
        """Unit vector towards the camera."""
        return _leaning(-self.camera_deg)


def _leaning(angle_deg: float) -> FloatArray:
    angle = np.radians(angle_deg)
    return np.array([0.0, np.sin(angle), np.cos(angle)])


def butterfly(folder: Path, film: Scene, name: str, place: float) -> dict[str, Scene]:
    """Return the objects of one insect with this film on its wings, its middle at x = `place`."""
    import mitsuba as mi

    to_world = mi.ScalarTransform4f().translate([place, 0.0, 0.25])
    shared = mi.load_dict(film)  # each instance would be compiled by itself
    looks = {part: mi.load_dict(_winged(part, shared)) for part in WINGS}
    parts = {
        f"{name}-{part}-{side}": _ply(folder, f"{part}-{side}", to_world, looks[part])
        for part in WINGS
        for side in SIDES
    }
    dark = {"type": "roughplastic", "diffuse_reflectance": 0.012, "alpha": 0.3}
    return parts | {f"{name}-body": _ply(folder, "body", to_world, dark)}


def _ply(folder: Path, name: str, to_world: object, bsdf: object) -> Scene:
    """Return a mesh from a file, which is written if it is not there."""
    file = folder / f"{name}.ply"
    if not file.is_file():
        kind, _, side = name.partition("-")
        write_ply(body() if kind == "body" else wing(kind, "left" if side == "left" else "right"), file)
    return {"type": "ply", "filename": str(file), "to_world": to_world, "bsdf": bsdf}


def _winged(name: str, film: object) -> Scene:
    """Return the film where a wing has no pigment, from both sides; Mitsuba counts v from the first row."""
    import mitsuba as mi

    pigment = {
        "type": "bitmap",
        "bitmap": mi.Bitmap(wing_pigment(name)[::-1, :, None].astype(np.float32)),
        "raw": True,
        "wrap_mode": "clamp",
    }
    dark = {"type": "diffuse", "reflectance": 0.008}
    return {"type": "twosided", "bsdf": {"type": "blendbsdf", "weight": pigment, "film": film, "dark": dark}}


def row_scene(folder: Path, films: Sequence[Scene], view: View, height: int) -> Scene:
    """Return butterflies in a row on a ground, in the light of a small and distant lamp."""
    middle = (len(films) - 1) / 2
    insects: dict[str, Scene] = {}
    for at, film in enumerate(films):
        insects |= butterfly(folder, film, f"butterfly-{at}", (at - middle) * SPACING)
    return {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 2},
        "sensor": camera(view, len(films), height),
        "light": lamp(view),
        "ground": ground(),
    } | insects


def captioned(row: Image.Image, text: str) -> Image.Image:
    """Return a row with a line under it, in a size for its width; `labelled` goes by a panel's height."""
    size = max(9, round(row.width / 85))
    font = ImageFont.truetype(findfont(FontProperties(family="DejaVu Sans")), size)
    picture = Image.new("RGB", (row.width, row.height + 2 * size), PAPER)
    picture.paste(row)
    ImageDraw.Draw(picture).text((row.width / 2, row.height + size), text, fill=INK, font=font, anchor="mm")
    return picture


def camera(view: View, count: int, height: int) -> Scene:
    """Return a camera without perspective: every pixel looks in the same direction."""
    import mitsuba as mi

    across, up = SPACING * count + 0.1, 2.32
    origin = 20 * view.to_camera + [0.0, -0.03, 0.2]
    looking = mi.ScalarTransform4f().look_at(
        origin.tolist(), (origin - view.to_camera).tolist(), [0.0, 1.0, 0.0]
    )
    # The picture spans -1 to 1 across its larger side.
    return {
        "type": "orthographic",
        "to_world": looking @ mi.ScalarTransform4f().scale([across / 2, across / 2, 1]),
        "film": {
            "type": "hdrfilm",
            "width": round(height * across / up),
            "height": height,
            "pixel_format": "rgb",
            "rfilter": {"type": "gaussian"},
        },
    }


def lamp(view: View) -> Scene:
    """Return a disc of D65, far away, that lights a white card facing it like a room of radiance 1."""
    import mitsuba as mi

    distance = 200.0
    radius = distance * np.tan(np.radians(LIGHT_BREADTH_DEG / 2))
    place = distance * view.to_light
    return {
        "type": "disk",
        "to_world": mi.ScalarTransform4f().look_at(place.tolist(), [0.0, 0.0, 0.0], [1.0, 0.0, 0.0])
        @ mi.ScalarTransform4f().scale([radius, radius, 1]),
        "emitter": {
            "type": "area",
            "radiance": {"type": "d65", "scale": float((distance / radius) ** 2)},
        },
    }


def ground(reflectance: float = 0.45) -> Scene:
    """Return the grey that the insects lie on."""
    import mitsuba as mi

    return {
        "type": "rectangle",
        "to_world": mi.ScalarTransform4f().scale([60, 60, 1]),
        "bsdf": {"type": "diffuse", "reflectance": reflectance},
    }
