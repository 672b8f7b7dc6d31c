"""A trefoil knot: smooth, and facing every direction, so that a film shows all of its colours on it."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

ALONG, AROUND = 400, 64
TUBE_RADIUS = 0.27


def torus_knot(bsdf: dict[str, Any]) -> Any:  # noqa: ANN401 - a type of the variant
    """Return the knot as a mesh of Mitsuba that stands on z = 0."""
    import mitsuba as mi

    points, normals = tube()
    props = mi.Properties()
    props["bsdf"] = mi.load_dict(bsdf)
    mesh = mi.Mesh("knot", len(points), 2 * ALONG * AROUND, has_vertex_normals=True, props=props)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = points.ravel().astype(np.float32)
    parameters["vertex_normals"] = normals.ravel().astype(np.float32)
    parameters["faces"] = faces().ravel().astype(np.uint32)
    parameters.update()
    return mesh


def tube() -> tuple[FloatArray, FloatArray]:
    """Return points and outward normals of a tube around the curve, (ALONG * AROUND, 3) each."""
    t = np.linspace(0, 2 * np.pi, ALONG, endpoint=False)
    centre = curve(t)
    tangent = unit(np.roll(centre, -1, axis=0) - np.roll(centre, 1, axis=0))
    side = unit(np.cross(tangent, [0.0, 1.0, 0.0]) + 1e-9)
    up = np.cross(side, tangent)
    turn = np.linspace(0, 2 * np.pi, AROUND, endpoint=False)
    normals = side[:, None] * np.cos(turn)[:, None] + up[:, None] * np.sin(turn)[:, None]
    points = centre[:, None] + TUBE_RADIUS * normals
    points[..., 2] -= points[..., 2].min()
    return points.reshape(-1, 3), normals.reshape(-1, 3)


def curve(t: FloatArray) -> FloatArray:
    """Return the trefoil (sin t + 2 sin 2t, cos t - 2 cos 2t, -sin 3t), upright and facing -y, (P, 3)."""
    x, z, y = np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)
    return np.stack([0.33 * x - 0.25, 0.38 * y + 0.3, 0.33 * z], axis=-1)


def faces() -> NDArray[np.int64]:
    """Return the triangles, counter-clockwise from outside, (F, 3)."""
    at = np.arange(ALONG * AROUND).reshape(ALONG, AROUND)
    along, around = np.roll(at, -1, axis=0), np.roll(at, -1, axis=1)
    both = np.roll(along, -1, axis=1)
    return np.stack([at, along, both, at, both, around], axis=-1).reshape(-1, 3)


def unit(vectors: FloatArray) -> FloatArray:
    """Return vectors of length 1."""
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
