"""Triangles with normals and texture coordinates, and the PLY file that renderers read them from."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

__all__ = ["Mesh", "merged", "normalised", "sheet", "tube", "write_ply"]

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Mesh:
    """Triangles that share vertices.

    Parameters
    ----------
    positions, normals : array (V, 3)
        Normals are of length 1 and point outwards.
    uvs : array (V, 2)
        Texture coordinates.
    faces : array (F, 3)
        Vertices of each triangle, counter-clockwise seen from outside.
    """

    positions: FloatArray
    normals: FloatArray
    uvs: FloatArray
    faces: IntArray


def normalised(vectors: FloatArray) -> FloatArray:
    """Return vectors (…, 3) at length 1."""
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


def merged(meshes: Sequence[Mesh]) -> Mesh:
    """Return several meshes as one."""
    starts = np.cumsum([0, *(len(mesh.positions) for mesh in meshes[:-1])])
    return Mesh(
        np.concatenate([mesh.positions for mesh in meshes]),
        np.concatenate([mesh.normals for mesh in meshes]),
        np.concatenate([mesh.uvs for mesh in meshes]),
        np.concatenate([mesh.faces + start for mesh, start in zip(meshes, starts, strict=True)]),
    )


def tube(rings: FloatArray) -> Mesh:
    """Return the surface through rings of points, closed by its first and last ring, which are points.

    Parameters
    ----------
    rings : array (R, N, 3)
        Counter-clockwise seen against the direction in which rings follow one another: u runs around a ring
        and v from ring to ring.
    """
    around = np.roll(rings, -1, axis=1) - np.roll(rings, 1, axis=1)
    along = np.gradient(rings, axis=0)
    along[0], along[-1] = 0, 0
    normals = np.cross(around, along)
    normals[0], normals[-1] = rings[0] - rings[1].mean(axis=0), rings[-1] - rings[-2].mean(axis=0)
    return sheet(_seamed(rings), _seamed(normalised(normals)), _unit_square(len(rings), rings.shape[1] + 1))


def sheet(positions: FloatArray, normals: FloatArray, uvs: FloatArray) -> Mesh:
    """Return the triangles of a grid of points (R, C, 3), without those that have no area."""
    rows, columns = positions.shape[:2]
    at = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]
    faces = np.concatenate([np.stack(corners, axis=-1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))])
    flat = positions.reshape(-1, 3)
    first, second, third = (flat[faces[:, corner]] for corner in range(3))
    area = np.linalg.norm(np.cross(second - first, third - first), axis=1)
    return Mesh(flat, normals.reshape(-1, 3), uvs.reshape(-1, 2), faces[area > _LEAST_AREA])


def _seamed(grid: FloatArray) -> FloatArray:
    """Repeat the first column as the last, where u is 1 instead of 0."""
    return np.concatenate([grid, grid[:, :1]], axis=1)


def _unit_square(rows: int, columns: int) -> FloatArray:
    v, u = np.meshgrid(np.linspace(0, 1, rows), np.linspace(0, 1, columns), indexing="ij")
    return np.stack([u, v], axis=-1)


_LEAST_AREA = 1e-11
"""Twice the area below which a triangle is a point or a line, rounded."""

_HEADER = """ply
format binary_little_endian 1.0
element vertex {vertices}
property float x
property float y
property float z
property float nx
property float ny
property float nz
property float u
property float v
element face {faces}
property list uchar int vertex_indices
end_header
"""


def write_ply(mesh: Mesh, path: Path) -> Path:
    """Write a mesh as a binary PLY file and return its path."""
    vertices = np.concatenate([mesh.positions, mesh.normals, mesh.uvs], axis=1).astype("<f4")
    faces = np.empty(len(mesh.faces), np.dtype([("count", "u1"), ("corners", "<i4", 3)]))
    faces["count"], faces["corners"] = 3, mesh.faces
    header = _HEADER.format(vertices=len(vertices), faces=len(faces))
    path.write_bytes(header.encode("ascii") + vertices.tobytes() + faces.tobytes())
    return path
