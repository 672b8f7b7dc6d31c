"""Spheres in a small studio, each with a Nacreous table: a picture of the plugin at work.

    python scene.py anodised-titanium.exr soap-bubble.exr --alpha 0.15 0 --thickness-scale 0.3 0.8

Spectral tables, ``film.spectral.exr``, are rendered in a spectral variant. The thickness runs from the first
scale at the top of a sphere to the last at its bottom, as in a film that drains. `studio` returns what
`mitsuba.load_dict` takes: a start for a scene of your own.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import mitsuba as mi
import numpy as np

RADIUS = 1.0
DISTANCE = 2.3
"""Between the centres of spheres, in radii."""
SAMPLES_PER_PASS = 32
"""Of each pixel: a gigabyte of paths for a picture of 700 by 256."""


def main() -> None:
    """Render what the command line says."""
    options = parse()
    spectral = ".spectral." in options.tables[0].name
    mi.set_variant(options.variant or ("llvm_ad_spectral" if spectral else "llvm_ad_rgb"))
    import nacreous_bsdf

    nacreous_bsdf.register()
    given = {} if options.int_ior is None else {"int_ior": options.int_ior}
    alphas = options.alpha * len(options.tables) if len(options.alpha) == 1 else options.alpha
    films = [
        film(table, alpha, options.thickness_scale) | given
        for table, alpha in zip(options.tables, alphas, strict=True)
    ]
    scene = mi.load_dict(studio(films, options.height))
    mi.util.write_bitmap(str(options.output), render(scene, options.samples), write_async=False)


def render(scene: mi.Scene, samples: int) -> mi.TensorXf:
    """Return the mean of several small renderings: vectorised variants hold all of one's paths in memory."""
    passes = -(-samples // SAMPLES_PER_PASS)
    per_pass = -(-samples // passes)
    pictures = (np.array(mi.render(scene, spp=per_pass, seed=seed)) for seed in range(passes))
    return mi.TensorXf(sum(pictures) / passes)


def parse() -> argparse.Namespace:
    """Return the options."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("tables", nargs="+", type=Path, help="lookup textures, a sphere for each")
    parser.add_argument("--alpha", nargs="+", type=float, default=[0.0], help="roughness, of each or of all")
    parser.add_argument(
        "--thickness-scale", nargs=2, type=float, default=[1.0, 1.0], metavar=("TOP", "BOTTOM")
    )
    parser.add_argument("--int-ior", type=float, help="of spheres that transmit, unless their file tells")
    parser.add_argument("--variant", help="of Mitsuba; by default llvm_ad_rgb or llvm_ad_spectral")
    parser.add_argument("--height", type=int, default=256, help="of the picture, in pixels")
    parser.add_argument("--samples", type=int, default=256, help="of each pixel")
    parser.add_argument("-o", "--output", type=Path, default=Path("spheres.png"), help="a PNG or an EXR")
    return parser.parse_args()


def film(table: Path, alpha: float, thickness_scale: list[float]) -> dict:
    """Return the plugin with a table, and a thickness that changes from the top to the bottom."""
    return {
        "type": "nacreous",
        "filename": str(table),
        "alpha": alpha,
        "thickness_scale": {
            "type": "bitmap",
            "bitmap": mi.Bitmap(np.linspace(*thickness_scale, 256, dtype=np.float32)[:, None, None]),
            "raw": True,
            "wrap_mode": "clamp",
        },
    }


def studio(films: list[dict], height: int) -> dict:
    """Return the scene: spheres in a row on a floor, soft lights around, a camera in front."""
    middle = (len(films) - 1) / 2
    return {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 16},
        "sensor": camera(len(films), height),
        "light": {
            "type": "envmap",
            "bitmap": mi.Bitmap(lights()),
            "to_world": mi.ScalarTransform4f().rotate([1, 0, 0], 90),
        },
        "floor": floor(),
    } | {
        f"sphere-{at}": {
            "type": "sphere",
            "center": [(at - middle) * DISTANCE * RADIUS, 0, RADIUS],
            "radius": RADIUS,
            "bsdf": bsdf,
        }
        for at, bsdf in enumerate(films)
    }


def camera(spheres: int, height: int) -> dict:
    """Return a camera that has a row of spheres in its picture."""
    return {
        "type": "perspective",
        "fov_axis": "y",
        "fov": 15,
        "to_world": mi.ScalarTransform4f().look_at([0, -10, 3.2], [0, 0, 0.95 * RADIUS], [0, 0, 1]),
        "film": {
            "type": "hdrfilm",
            "width": round(height * (0.2 + 0.85 * spheres)),
            "height": height,
            "rfilter": {"type": "gaussian"},
        },
    }


def floor() -> dict:
    """Return a chequered floor, which shows what a film lets through."""
    squares = {
        "type": "checkerboard",
        "color0": 0.05,
        "color1": 0.16,
        "to_uv": mi.ScalarTransform4f().scale([16, 16, 1]),
    }
    return {
        "type": "rectangle",
        "to_world": mi.ScalarTransform4f().scale([20, 20, 1]),
        "bsdf": {"type": "diffuse", "reflectance": squares},
    }


def lights() -> np.ndarray:
    """Return a latitude-longitude picture of a dim room with soft boxes, (H, W, 3)."""
    height, width = 128, 256
    latitude = np.linspace(90, -90, height)[:, None]
    longitude = np.linspace(-180, 180, width)[None, :]
    room = 0.25 + 0.35 * np.clip(latitude / 90, 0, 1) + 0 * longitude
    for at_longitude, at_latitude, across, up, radiance in (
        (-70, 40, 38, 30, 3.0),
        (75, 30, 14, 40, 3.5),
        (170, 25, 60, 16, 2.0),
        (0, 85, 180, 14, 3.0),
    ):
        inside_x = np.clip((across - abs(longitude - at_longitude)) / 4 + 0.5, 0, 1)
        inside_y = np.clip((up - abs(latitude - at_latitude)) / 4 + 0.5, 0, 1)
        room = room + radiance * inside_x * inside_y
    return np.repeat(room[..., None], 3, axis=-1).astype(np.float32)


if __name__ == "__main__":
    main()
