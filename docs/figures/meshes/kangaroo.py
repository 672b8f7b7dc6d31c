"""A kangaroo of our own: rounded cones and ellipsoids, smoothly united, as the zero of a distance field."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from figures.meshes.mesh import Mesh, normalised

__all__ = ["distance", "kangaroo"]

FloatArray = NDArray[np.float64]
Point = tuple[float, float, float]

_LOW, _HIGH = np.array([-1.62, -0.5, -0.04]), np.array([0.82, 0.5, 2.12])


@dataclass(frozen=True)
class RoundedCone:
    """Spheres from one point to another, their radius changing linearly."""

    start: Point
    stop: Point
    radius: float
    last_radius: float
    blend: float = 0.05

    def distance(self, points: FloatArray) -> FloatArray:
        """Return about the distance of points (…, 3) to the surface, negative inside."""
        axis = np.subtract(self.stop, self.start)
        share = np.clip((points - self.start) @ axis / (axis @ axis), 0, 1)
        radius = self.radius + share * (self.last_radius - self.radius)
        return np.asarray(np.linalg.norm(points - self.start - share[..., None] * axis, axis=-1) - radius)


@dataclass(frozen=True)
class Ellipsoid:
    """An ellipsoid with one axis given, one across the animal's plane of symmetry as far as that allows."""

    centre: Point
    axis: Point
    radii: Point
    blend: float = 0.05

    def distance(self, points: FloatArray) -> FloatArray:
        """Return about the distance: exact to first order at the surface."""
        first = normalised(np.array(self.axis, np.float64))
        second = normalised(np.cross(np.cross(first, [0.0, 1.0, 0.0]), first))
        frame = np.stack([first, second, np.cross(first, second)])
        scaled = (points - self.centre) @ frame.T / self.radii
        reach = np.linalg.norm(scaled, axis=-1)
        slope = np.linalg.norm(scaled / self.radii, axis=-1)
        return np.asarray(reach * (reach - 1) / np.maximum(slope, 1e-9))


Part = RoundedCone | Ellipsoid

_TRUNK: tuple[Part, ...] = (
    RoundedCone((-0.16, 0, 0.66), (0.14, 0, 1.16), 0.27, 0.19, 0.1),
    RoundedCone((0.14, 0, 1.16), (0.26, 0, 1.34), 0.17, 0.13, 0.1),
    RoundedCone((0.24, 0, 1.32), (0.36, 0, 1.62), 0.115, 0.085, 0.08),
    Ellipsoid((0.10, 0, 0.82), (0.35, 0, 1.0), (0.30, 0.19, 0.22), 0.1),
)
_HEAD: tuple[Part, ...] = (
    Ellipsoid((0.385, 0, 1.675), (1.0, 0, -0.3), (0.15, 0.115, 0.105), 0.05),
    RoundedCone((0.44, 0, 1.65), (0.62, 0, 1.575), 0.085, 0.052, 0.05),
    RoundedCone((0.645, 0, 1.592), (0.66, 0, 1.588), 0.022, 0.022, 0.02),
)
_TAIL: tuple[Part, ...] = (
    RoundedCone((-0.26, 0, 0.56), (-0.55, 0, 0.26), 0.20, 0.125, 0.1),
    RoundedCone((-0.55, 0, 0.26), (-0.86, 0, 0.11), 0.125, 0.088, 0.06),
    RoundedCone((-0.86, 0, 0.11), (-1.20, 0, 0.062), 0.088, 0.058, 0.06),
    RoundedCone((-1.20, 0, 0.062), (-1.52, 0, 0.05), 0.058, 0.032, 0.06),
)


def _pair(side: int) -> tuple[Part, ...]:
    """Return the limbs, the ear and the eye of one side, +1 or -1."""
    s = side
    return (
        Ellipsoid((-0.06, 0.20 * s, 0.62), (0.62, 0, -0.42), (0.34, 0.22, 0.125), 0.08),
        RoundedCone((0.20, 0.24 * s, 0.44), (-0.20, 0.22 * s, 0.13), 0.105, 0.052, 0.05),
        RoundedCone((-0.22, 0.22 * s, 0.075), (0.10, 0.235 * s, 0.055), 0.062, 0.05, 0.04),
        RoundedCone((0.10, 0.235 * s, 0.055), (0.40, 0.25 * s, 0.04), 0.05, 0.034, 0.04),
        RoundedCone((0.20, 0.15 * s, 1.24), (0.235, 0.21 * s, 0.99), 0.085, 0.055, 0.06),
        RoundedCone((0.235, 0.21 * s, 0.99), (0.41, 0.16 * s, 0.885), 0.05, 0.034, 0.03),
        RoundedCone((0.41, 0.16 * s, 0.885), (0.47, 0.15 * s, 0.835), 0.038, 0.03, 0.03),
        Ellipsoid((0.275, 0.105 * s, 1.875), (-0.16, 0.22 * s, 1.0), (0.175, 0.036, 0.066), 0.03),
        RoundedCone((0.44, 0.088 * s, 1.71), (0.45, 0.09 * s, 1.712), 0.022, 0.022, 0.008),
    )


_PARTS = (*_TRUNK, *_TAIL, *_HEAD, *_pair(1), *_pair(-1))


def distance(points: FloatArray, parts: Sequence[Part] = _PARTS) -> FloatArray:
    """Return the field of the whole animal at points (…, 3): its surface is where it is 0."""
    field = parts[0].distance(points)
    for part in parts[1:]:
        field = _united(field, part.distance(points), part.blend)
    return field


def _united(a: FloatArray, b: FloatArray, blend: float) -> FloatArray:
    """Return the smaller of two distances, rounded off where they differ by less than `blend`.

    The quadratic smooth minimum: its slope is continuous.
    """
    nearness = np.maximum(blend - np.abs(a - b), 0) / blend
    return np.minimum(a, b) - nearness**2 * blend / 4


def _gradient(points: FloatArray) -> FloatArray:
    step = 1e-4
    ahead = [distance(points + step * axis) - distance(points - step * axis) for axis in np.eye(3)]
    return np.stack(ahead, axis=-1) / (2 * step)


def kangaroo(cell: float = 0.014) -> Mesh:
    """Return the kangaroo, its feet and tail on z = 0, looking towards +x, 2.05 high.

    Horizontal sections are lines of equal v, so that u runs around it.

    Parameters
    ----------
    cell : float
        Size of the cubes that the surface is found in.
    """
    from skimage.measure import marching_cubes  # half a second, and only this mesh needs it

    counts = np.ceil((_HIGH - _LOW) / cell).astype(int) + 1
    grid = np.stack(np.meshgrid(*(np.arange(count) for count in counts), indexing="ij"), axis=-1)
    field = distance(_LOW + cell * grid)
    corners, faces, _, _ = marching_cubes(field, 0.0, gradient_direction="descent")
    positions = _drawn_to_surface(_LOW + cell * corners.astype(np.float64))
    return _with_seam(positions, normalised(_gradient(positions)), faces.astype(np.int64))


def _drawn_to_surface(points: FloatArray) -> FloatArray:
    """Correct what linear interpolation within a cube leaves: two of Newton's steps along the gradient."""
    for _ in range(2):
        slope = _gradient(points)
        points = points - (distance(points) / np.sum(slope**2, axis=-1))[..., None] * slope
    return points


def _with_seam(positions: FloatArray, normals: FloatArray, faces: NDArray[np.int64]) -> Mesh:
    """Add texture coordinates: the azimuth about the vertical axis, and the height.

    Where the azimuth leaps from 1 to 0 within a triangle, its vertices after the leap are doubled with u + 1.
    """
    u = np.arctan2(positions[:, 1], positions[:, 0]) / (2 * np.pi) + 0.5
    uvs = np.stack([u, (positions[:, 2] - _LOW[2]) / (_HIGH[2] - _LOW[2])], axis=-1)
    leaps = np.ptp(u[faces], axis=1) > 0.5
    late = np.unique(faces[leaps][u[faces[leaps]] < 0.5])
    double = np.arange(len(positions))
    double[late] = len(positions) + np.arange(len(late))
    faces = faces.copy()
    faces[leaps] = double[faces[leaps]]
    return Mesh(
        np.concatenate([positions, positions[late]]),
        np.concatenate([normals, normals[late]]),
        np.concatenate([uvs, uvs[late] + [1.0, 0.0]]),
        faces,
    )
