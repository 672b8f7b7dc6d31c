"""A studio in Mitsuba 3, in which interference can be enjoyed: soft boxes in a dim room, a floor, a camera.

z is up; the camera looks towards +y. The room is a picture of all directions: of an azimuth,
0 degrees straight ahead of the camera (behind the objects), 90 to the right, 180 behind the camera, 270 to
the left, and an elevation above the horizon. Light is D65 unless it has a colour.

Mitsuba is imported within the functions: its types depend on the variant, which `use_mitsuba` chooses.
"""

import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mitsuba_surface import variant_fault

FloatArray = NDArray[np.float64]
Scene = dict[str, Any]
"""What `mitsuba.load_dict` takes."""

VARIANT = "llvm_ad_spectral"
CLIENT = Path(__file__).parents[2] / "clients" / "mitsuba"
PATHS_PER_STRIP = 2_000_000
"""Vectorised variants hold all paths of a rendering in memory, and are fastest while these are few."""
ROOM_HEIGHT, ROOM_WIDTH = 512, 1024
MAX_DEPTH = 16


def use_mitsuba() -> None:
    """Choose the spectral variant and make the plugin of clients/mitsuba known to it."""
    if fault := variant_fault(VARIANT):
        raise SystemExit(f"expected Mitsuba 3 with {VARIANT}: {fault}")
    import mitsuba as mi

    if str(CLIENT) not in sys.path:
        sys.path.append(str(CLIENT))
    import nacreous_bsdf

    mi.set_variant(VARIANT)
    nacreous_bsdf.register()


def rendered(scene: Scene, samples: int) -> FloatArray:
    """Return linear Rec.709 (H, W, 3), white being a white surface's in the light of radiance 1.

    In strips of rows, each with one seed: the same picture each time. A strip has all samples of its pixels
    at once, so that they can be stratified, wavelengths included.
    """
    import mitsuba as mi

    loaded = mi.load_dict(scene)
    width, height = (scene["sensor"]["film"][side] for side in ("width", "height"))
    rows = max(1, PATHS_PER_STRIP // (width * samples))
    strips = []
    for top in range(0, height, rows):
        sensor = mi.load_dict(_strip(scene["sensor"], top, min(rows, height - top), samples))
        strips.append(np.array(mi.render(loaded, sensor=sensor, spp=samples, seed=top), np.float64))
    return np.concatenate(strips)


def _strip(sensor: Scene, top: int, rows: int, samples: int) -> Scene:
    """Return a camera that sees some rows of its picture alone."""
    width = sensor["film"]["width"]
    crop = {"crop_offset_x": 0, "crop_offset_y": top, "crop_width": width, "crop_height": rows}
    sampler = {"type": "multijitter", "sample_count": samples}
    return {**sensor, "film": {**sensor["film"], **crop}, "sampler": sampler}


# ---- light -------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class SoftBox:
    """A rectangle of light in the room: where its middle is, how far it reaches, all in degrees.

    `edge_deg` is the breadth over which it fades; `colour` is a tint in linear Rec.709.
    """

    azimuth_deg: float
    elevation_deg: float
    width_deg: float
    height_deg: float
    radiance: float
    edge_deg: float = 3.0
    colour: tuple[float, float, float] = (1.0, 1.0, 1.0)


@dataclass(frozen=True)
class Walls:
    """Radiance of the room itself: below the horizon, at it, and at the zenith; colours in linear Rec.709."""

    below: tuple[float, float, float] = (0.02, 0.02, 0.02)
    horizon: tuple[float, float, float] = (0.12, 0.12, 0.12)
    zenith: tuple[float, float, float] = (0.04, 0.04, 0.04)


def room(boxes: Iterable[SoftBox], walls: Walls | None = None) -> Scene:
    """Return the light of a room with soft boxes, as an ``envmap``."""
    import mitsuba as mi

    azimuth = (np.arange(ROOM_WIDTH) + 0.5) / ROOM_WIDTH * 360
    elevation = 90 - (np.arange(ROOM_HEIGHT) + 0.5) / ROOM_HEIGHT * 180
    radiance = np.repeat(_wall(walls or Walls(), elevation)[:, None], ROOM_WIDTH, axis=1)  # (H, W, 3)
    for box in boxes:
        x = _inside((azimuth - box.azimuth_deg + 180) % 360 - 180, box.width_deg, box.edge_deg)
        y = _inside(elevation - box.elevation_deg, box.height_deg, box.edge_deg)
        radiance += box.radiance * (y[:, None] * x)[..., None] * np.array(box.colour)
    return {
        "type": "envmap",
        "bitmap": mi.Bitmap(radiance.astype(np.float32)),
        "to_world": mi.ScalarTransform4f().rotate([1, 0, 0], 90),
    }


def _wall(walls: Walls, elevation_deg: FloatArray) -> FloatArray:
    """Return the radiance of the walls at an elevation, (H, 3)."""
    up = np.sqrt(np.clip(elevation_deg / 90, 0, 1))[:, None]
    above = (1 - up) * np.array(walls.horizon) + up * np.array(walls.zenith)
    return np.where(elevation_deg[:, None] < 0, np.array(walls.below), above)


def _inside(distance_deg: FloatArray, extent_deg: float, edge_deg: float) -> FloatArray:
    """Return 1 inside of an extent, 0 outside, with a smooth edge."""
    x = np.clip((extent_deg / 2 - abs(distance_deg)) / edge_deg + 0.5, 0, 1)
    return x * x * (3 - 2 * x)


# ---- floor, camera, scene ----------------------------------------------------------------------------------


def chequered(
    dark: float = 0.05,
    light: float = 0.16,
    square: float = 1.25,
    extent: float = 40.0,
    turn_deg: float = 0.0,
) -> Scene:
    """Return a chequered floor at z = 0, which shows what is reflected and what is let through."""
    import mitsuba as mi

    squares = {
        "type": "checkerboard",
        "color0": dark,
        "color1": light,
        "to_uv": mi.ScalarTransform4f().rotate([0, 0, 1], turn_deg).scale(extent / square),
    }
    return {
        "type": "rectangle",  # its far edge is level, whichever way the squares lie
        "to_world": mi.ScalarTransform4f().scale([extent, extent, 1]),
        "bsdf": {"type": "diffuse", "reflectance": squares},
    }


def plain(reflectance: float = 0.12, extent: float = 40.0) -> Scene:
    """Return a floor of one grey at z = 0."""
    import mitsuba as mi

    return {
        "type": "rectangle",
        "to_world": mi.ScalarTransform4f().scale([extent, extent, 1]),
        "bsdf": {"type": "diffuse", "reflectance": reflectance},
    }


@dataclass(frozen=True)
class Camera:
    """Where a camera stands and looks, and what it sees: an angle upwards, and the picture's aspect."""

    origin: tuple[float, float, float]
    target: tuple[float, float, float]
    fov_deg: float
    aspect: float

    def sensor(self, height: int) -> Scene:
        """Return it for a picture of some height in pixels."""
        import mitsuba as mi

        return {
            "type": "perspective",
            "fov_axis": "y",
            "fov": self.fov_deg,
            "to_world": mi.ScalarTransform4f().look_at(list(self.origin), list(self.target), [0, 0, 1]),
            "film": {
                "type": "hdrfilm",
                "width": round(height * self.aspect),
                "height": height,
                "pixel_format": "rgb",
                "rfilter": {"type": "box"},  # others would need the rows of the next strip
            },
        }


def scene(light: Scene, camera: Camera, height: int, objects: dict[str, Scene]) -> Scene:
    """Return what `rendered` takes."""
    return {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": MAX_DEPTH},
        "sensor": camera.sensor(height),
        "light": light,
    } | objects


def film(table: Path, **parameters: object) -> Scene:
    """Return the plugin with a spectral table; its parameters are those of clients/mitsuba."""
    return {"type": "nacreous", "filename": str(table), **parameters}


def measured(file: Path) -> Scene:
    """Return Mitsuba's own ``measured`` with a ``.bsdf`` of Nacreous."""
    return {"type": "measured", "filename": str(file)}
