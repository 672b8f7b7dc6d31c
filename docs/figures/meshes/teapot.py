"""A teapot of our own: body and lid from the lathe, a swept spout and a swept handle."""

import numpy as np

from figures.meshes.mesh import Mesh, merged
from figures.meshes.sweep import lathed, swept

__all__ = ["teapot"]

_BODY = (
    (0.0, 0.0), (0.30, 0.005), (0.52, 0.02), (0.57, 0.055), (0.63, 0.12), (0.82, 0.28), (0.96, 0.52),
    (0.98, 0.76), (0.87, 1.02), (0.69, 1.20), (0.60, 1.27), (0.575, 1.305), (0.53, 1.315), (0.48, 1.28),
    (0.25, 1.26), (0.0, 1.26),
)  # fmt: skip
"""Radius and height: a foot, a round belly, a rim with a seat for the lid."""
_LID = (
    (0.0, 1.27), (0.30, 1.275), (0.49, 1.285), (0.52, 1.315), (0.50, 1.345), (0.36, 1.42), (0.20, 1.475),
    (0.105, 1.51), (0.075, 1.55), (0.085, 1.59), (0.135, 1.64), (0.15, 1.70), (0.115, 1.755), (0.05, 1.78),
    (0.0, 1.783),
)  # fmt: skip
_SPOUT = ((0.72, 0, 0.42), (1.02, 0, 0.50), (1.24, 0, 0.74), (1.36, 0, 1.02), (1.55, 0, 1.22))
_SPOUT_RADII = (
    (0.0, 0.0), (0.0, 0.24), (0.3, 0.225), (0.55, 0.15), (0.8, 0.105), (0.97, 0.108), (1.0, 0.10),
    (0.985, 0.083), (0.9, 0.075), (0.7, 0.07), (0.7, 0.0),
)  # fmt: skip
_HANDLE = (
    (-0.70, 0, 1.12), (-1.05, 0, 1.20), (-1.42, 0, 1.08), (-1.50, 0, 0.78), (-1.30, 0, 0.48),
    (-0.86, 0, 0.34),
)  # fmt: skip
_HANDLE_RADII = ((0.0, 0.0), (0.0, 0.075), (0.5, 0.06), (1.0, 0.075), (1.0, 0.0))


def teapot(fineness: float = 1.0) -> Mesh:
    """Return the teapot, its foot on z = 0, its spout towards +x, 1.8 high.

    Parameters
    ----------
    fineness : float
        Points along each direction, as a part of the 320 around the body that a picture takes.
    """
    around = round(320 * fineness)
    sideways = np.array([0.0, 1.0, 0.0])
    thin = {"sideways": sideways, "along": round(200 * fineness), "around": round(96 * fineness)}
    return merged(
        [
            lathed(_BODY, along=round(260 * fineness), around=around),
            lathed(_LID, along=round(220 * fineness), around=around),
            swept(_SPOUT, _SPOUT_RADII, **thin),
            swept(_HANDLE, _HANDLE_RADII, flat=1.35, **thin),
        ]
    )
