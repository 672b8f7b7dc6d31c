"""A sphere to look at a glTF material on, in the file itself."""

import base64
from typing import Any

import numpy as np

__all__ = ["sphere"]

_PARALLELS, _MERIDIANS = 24, 48
_FLOAT, _UNSIGNED_SHORT = 5126, 5123
_VERTICES, _INDICES = 34962, 34963
"""Component types and buffer targets of glTF 2.0, sections 5.1.3 and 5.11.5."""


def sphere() -> dict[str, Any]:
    """Return the parts of a glTF document, all but the material 0 that they use.

    The sphere has radius 1, so that its positions are its normals: both are one accessor.
    """
    positions, indices = _positions(), _indices()
    data = positions.tobytes() + indices.tobytes()
    uri = f"data:application/octet-stream;base64,{base64.b64encode(data).decode()}"
    primitive = {"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1, "material": 0}
    return {
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "sphere", "mesh": 0}],
        "meshes": [{"name": "sphere", "primitives": [primitive]}],
        "accessors": [_position_accessor(positions), _index_accessor(indices)],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": positions.nbytes, "target": _VERTICES},
            {
                "buffer": 0,
                "byteOffset": positions.nbytes,
                "byteLength": indices.nbytes,
                "target": _INDICES,
            },
        ],
        "buffers": [{"byteLength": len(data), "uri": uri}],
    }


def _positions() -> np.ndarray:
    """Vertices (P, 3), parallel by parallel from the pole at +y, the first meridian twice."""
    polar = np.linspace(0, np.pi, _PARALLELS + 1)[:, None]
    azimuth = np.linspace(0, 2 * np.pi, _MERIDIANS + 1)
    x, z = np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth)
    y = np.broadcast_to(np.cos(polar), x.shape)
    return np.stack([x, y, z], axis=-1).reshape(-1, 3).astype("<f4")


def _indices() -> np.ndarray:
    """Triangles, counter-clockwise from outside; those that the poles make lines of are left out."""
    row, column = np.mgrid[0:_PARALLELS, 0:_MERIDIANS]
    upper = row * (_MERIDIANS + 1) + column
    lower = upper + _MERIDIANS + 1
    first = np.stack([upper, upper + 1, lower], axis=-1)[1:]
    second = np.stack([upper + 1, lower + 1, lower], axis=-1)[:-1]
    return np.concatenate([first.ravel(), second.ravel()]).astype("<u2")


def _position_accessor(positions: np.ndarray) -> dict[str, Any]:
    return {
        "bufferView": 0,
        "componentType": _FLOAT,
        "count": len(positions),
        "type": "VEC3",
        "min": positions.min(axis=0).tolist(),
        "max": positions.max(axis=0).tolist(),
    }


def _index_accessor(indices: np.ndarray) -> dict[str, Any]:
    return {
        "bufferView": 1,
        "componentType": _UNSIGNED_SHORT,
        "count": indices.size,
        "type": "SCALAR",
    }
