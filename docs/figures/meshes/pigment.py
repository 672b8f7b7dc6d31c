"""Where a wing is dark instead of iridescent: its veins, and a margin with pale spots."""

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from scipy.ndimage import distance_transform_edt

from figures.meshes.wing import EXTENT, WINGS, Wing, outline

__all__ = ["wing_pigment"]

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class _Margin:
    """The dark edge away from the body, in units of the mesh; where it runs, in shares of the outline."""

    first: float
    last: float
    breadth: float


_MARGINS = {"fore": _Margin(0.24, 0.76, 0.12), "hind": _Margin(0.27, 0.74, 0.10)}
_SOFT = 0.03
"""Breadth over which the margin fades into the film."""
_CELL_END = 0.44
"""Part of the way to the outline at which the cell in a wing's middle ends."""
_ROOT_WIDTH, _RIM_WIDTH = 0.020, 0.008
"""Of a vein."""


def wing_pigment(name: str, pixels: int = 1024) -> FloatArray:
    """Return how dark a wing is, (2 pixels, pixels): 0 is the film alone, 1 is pigment; v upwards."""
    form = WINGS[name]
    return np.maximum(_margin(form, _MARGINS[name], pixels), _veins(form, pixels))


def _margin(form: Wing, margin: _Margin, pixels: int) -> FloatArray:
    rim = outline(form)
    outer = rim[round(margin.first * len(rim)) : round(margin.last * len(rim))]
    drawn = Image.new("L", (pixels, 2 * pixels), 255)
    ImageDraw.Draw(drawn).line(_pixels(outer, pixels), fill=0, width=2)
    distance = np.asarray(distance_transform_edt(np.asarray(drawn))) * EXTENT / pixels
    row, column = np.mgrid[: 2 * pixels, :pixels] / pixels * EXTENT
    angle = np.arctan2(EXTENT - row - form.root[1], column - form.root[0])
    breadth = margin.breadth * (1 + 0.18 * np.cos(28 * angle))
    dark = np.clip((breadth - distance) / _SOFT + 0.5, 0, 1)
    return np.asarray(dark * (1 - 0.85 * _spots(angle, distance, margin.breadth)))


def _spots(angle: FloatArray, distance: FloatArray, breadth: float) -> FloatArray:
    """Return a row of small spots along the middle of a margin, one between two scallops each."""
    across = (distance - 0.45 * breadth) / (0.16 * breadth)
    along = np.sin(14 * angle) / 0.42
    return np.asarray(np.clip(1.5 - np.hypot(across, along), 0, 1))


def _veins(form: Wing, pixels: int) -> FloatArray:
    """Return veins that leave the root together, part, and reach the outline; and the cell's end."""
    drawn = Image.new("L", (2 * pixels, 4 * pixels), 0)
    draw = ImageDraw.Draw(drawn)
    paths = [_vein(form, share) for share in form.veins]
    for path in paths:
        for place, (start, stop) in enumerate(itertools.pairwise(path)):
            width = _ROOT_WIDTH + (_RIM_WIDTH - _ROOT_WIDTH) * (place / len(path)) ** 0.5
            _stroke(draw, np.stack([start, stop]), width, 2 * pixels)
    end = np.stack([path[round(_CELL_END * len(path))] for path in paths[1:-1]])
    _stroke(draw, end, _RIM_WIDTH, 2 * pixels)
    return np.asarray(drawn.resize((pixels, 2 * pixels), Image.Resampling.BOX), np.float64) / 255


def _vein(form: Wing, share: float, count: int = 60) -> FloatArray:
    """Return a parabola from the root that starts along the wing's middle and ends on its outline."""
    rim, root = outline(form), np.array(form.root)
    middle = rim[round(np.mean(form.veins) * len(rim))]
    stop = rim[round(share * len(rim))]
    control = root + 0.42 * (0.5 * (middle - root) + 0.5 * (stop - root))
    t = np.linspace(0, 1, count)[:, None]
    return np.asarray((1 - t) ** 2 * root + 2 * t * (1 - t) * control + t**2 * stop)


def _stroke(draw: ImageDraw.ImageDraw, path: FloatArray, width: float, pixels: int) -> None:
    draw.line(_pixels(path, pixels), fill=255, width=max(1, round(width / EXTENT * pixels)), joint="curve")


def _pixels(points: FloatArray, pixels: int) -> list[tuple[float, float]]:
    """Return places in a picture of this width whose first row is at the head's end."""
    return [(pixels * x / EXTENT, pixels * (1 - y / EXTENT)) for x, y in points.tolist()]
