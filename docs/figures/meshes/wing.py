"""A butterfly of our own after the outline of a Morpho: four bent cards, a body, two antennae.

The right side is drawn, the left is its mirror image. x points from the body outwards, y to the head and z
up, from the upper side of the wings. A wing's u runs outwards along x, about as the ridges of its scales do,
and v along y, so that the pigment of `wing_pigment` fits either side.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from figures.meshes.mesh import Mesh, merged, normalised, sheet
from figures.meshes.sweep import swept

__all__ = ["EXTENT", "WINGS", "Side", "Wing", "body", "outline", "wing"]

FloatArray = NDArray[np.float64]
Side = Literal["right", "left"]

EXTENT = 1.5
"""u = x / EXTENT and v = 1/2 + y / (2 EXTENT)."""


@dataclass(frozen=True)
class Wing:
    """A wing of the right side.

    Parameters
    ----------
    root : tuple
        Where it joins the body, x and y.
    rim : tuple
        Points of its outline, from the root on along the front edge and back.
    veins : tuple
        Where its veins meet the outline, as shares of the way around; the cell that they start from ends at
        a part of their way.
    lowered : float
        How far it lies below the fore wing.
    """

    root: tuple[float, float]
    rim: tuple[tuple[float, float], ...]
    veins: tuple[float, ...]
    lowered: float


WINGS = {
    "fore": Wing(
        (0.05, 0.10),
        ((0.30, 0.42), (0.70, 0.78), (1.08, 0.97), (1.32, 0.98), (1.39, 0.84), (1.30, 0.56), (1.22, 0.30),
         (1.15, 0.06), (1.00, -0.10), (0.68, -0.11), (0.34, -0.05)),
        (0.33, 0.40, 0.47, 0.53, 0.59, 0.65, 0.71, 0.80),
        0.0,
    ),
    "hind": Wing(
        (0.05, 0.02),
        ((0.38, 0.10), (0.72, 0.06), (1.00, -0.06), (1.12, -0.30), (1.07, -0.55), (0.96, -0.76),
         (0.78, -0.94), (0.58, -1.02), (0.42, -0.90), (0.28, -0.62), (0.13, -0.30)),
        (0.30, 0.38, 0.45, 0.52, 0.59, 0.66, 0.73, 0.81),
        0.035,
    ),
}  # fmt: skip


def outline(form: Wing, count: int = 240) -> FloatArray:
    """Return a closed smooth curve around a wing, (count, 2), its root first; it has a corner there."""
    points = np.array([form.root, *form.rim, form.root])
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1) ** 0.5  # centripetal: no loops at sharp turns
    curve = CubicSpline(np.concatenate([[0], np.cumsum(steps)]), points)
    return np.asarray(curve(np.linspace(0, steps.sum(), count)))


def wing(name: str, side: Side, outwards: int = 48) -> Mesh:
    """Return a wing, ``"fore"`` or ``"hind"``, as rays from its root to its outline."""
    form = WINGS[name]
    rim, root = outline(form), np.array(form.root)
    share = np.linspace(0, 1, outwards)[None, :, None]
    plan = root + share * (rim[:, None] - root)  # (rays, outwards, 2)
    positions = np.concatenate([plan, (_height(plan) - form.lowered)[..., None]], axis=-1)
    uvs = plan / [EXTENT, 2 * EXTENT] + [0.0, 0.5]
    normals = _normals(plan)
    if side == "left":
        mirror = np.array([-1.0, 1.0, 1.0])
        return sheet(mirror * positions, mirror * normals, uvs)
    return sheet(positions[::-1], normals[::-1], uvs[::-1])  # the outline goes clockwise, seen from above


def _height(plan: FloatArray) -> FloatArray:
    """Return z over (x, y): raised from the body, arched, and slightly pleated along the veins."""
    x, y = plan[..., 0], plan[..., 1]
    pleat = 0.007 * np.sin(22 * np.arctan2(y - 0.05, x + 0.12)) * np.clip(x / 0.5, 0, 1) ** 2
    return np.asarray(0.30 * x - 0.15 * x**2 - 0.05 * y**2 + pleat)


def _normals(plan: FloatArray) -> FloatArray:
    step = 1e-5
    slopes = [(_height(plan + shift) - _height(plan - shift)) / (2 * step) for shift in step * np.eye(2)]
    return normalised(np.stack([-slopes[0], -slopes[1], np.ones(plan.shape[:-1])], axis=-1))


_BODY = ((0, 0.34, 0.06), (0, 0.20, 0.055), (0, 0.0, 0.04), (0, -0.35, 0.0), (0, -0.66, -0.03))
_BODY_RADII = (
    (0.0, 0.0), (0.01, 0.035), (0.07, 0.055), (0.125, 0.036), (0.22, 0.078), (0.36, 0.074), (0.45, 0.045),
    (0.6, 0.058), (0.8, 0.047), (0.97, 0.018), (1.0, 0.0),
)  # fmt: skip
"""Head, thorax and abdomen."""
_ANTENNA = ((0.02, 0.30, 0.08), (0.12, 0.52, 0.16), (0.25, 0.72, 0.20), (0.36, 0.86, 0.21))
_ANTENNA_RADII = ((0.0, 0.0), (0.01, 0.008), (0.7, 0.006), (0.92, 0.014), (1.0, 0.0))


def body() -> Mesh:
    """Return head, thorax, abdomen and antennae."""
    trunk = swept(_BODY, _BODY_RADII, sideways=(1.0, 0.0, 0.0), along=120, around=40)
    return merged([trunk, *(_antenna(side) for side in (1.0, -1.0))])


def _antenna(side: float) -> Mesh:
    """Return one antenna, +1 the right one; its curve lies so nearly in a plane that its tube is round."""
    path = np.array(_ANTENNA) * [side, 1.0, 1.0]
    return swept(path, _ANTENNA_RADII, sideways=_across(path), along=80, around=16)


def _across(path: FloatArray) -> FloatArray:
    """Return the unit normal of the plane that a curve about lies in."""
    _, _, axes = np.linalg.svd(path - path.mean(axis=0))
    return np.asarray(axes[-1])
