"""Surfaces swept by a circle: turned on a lathe, or led along a plane curve."""

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline, PchipInterpolator

from figures.meshes.mesh import Mesh, normalised, tube

__all__ = ["lathed", "smooth_curve", "swept"]

FloatArray = NDArray[np.float64]


def smooth_curve(points: ArrayLike, count: int) -> FloatArray:
    """Return `count` points, evenly spaced, of a smooth curve through points (P, D)."""
    given = np.asarray(points, np.float64)
    steps = np.linalg.norm(np.diff(given, axis=0), axis=1)
    reached = np.concatenate([[0], np.cumsum(steps)]) / steps.sum()
    curve = CubicSpline(reached, given, bc_type="natural")
    fine = curve(np.linspace(0, 1, 20 * count))
    lengths = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(fine, axis=0), axis=1))])
    even = np.interp(np.linspace(0, lengths[-1], count), lengths, np.linspace(0, 1, 20 * count))
    return np.asarray(curve(even))


def lathed(profile: ArrayLike, *, along: int, around: int) -> Mesh:
    """Turn a profile about the z axis.

    Parameters
    ----------
    profile : array (P, 2)
        Radius and height, upwards along the outside; a smooth curve is led through. It begins and ends on the
        axis, at radius 0.
    along, around : int
        Rings, and points of each.
    """
    curve = smooth_curve(profile, along)
    radius, height = np.maximum(curve[:, 0], 0), curve[:, 1]
    radius[[0, -1]] = 0
    angle = 2 * np.pi * np.arange(around) / around
    circle = np.stack([np.cos(angle), np.sin(angle), np.zeros(around)], axis=-1)
    return tube(radius[:, None, None] * circle + height[:, None, None] * np.array([0.0, 0.0, 1.0]))


def swept(
    path: ArrayLike, stations: ArrayLike, *, sideways: ArrayLike, along: int, around: int, flat: float = 1.0
) -> Mesh:
    """Lead a circle of changing radius along a curve in a plane.

    Parameters
    ----------
    path : array (P, 3)
        Points of the curve.
    stations : array (S, 2)
        Place on the path, 0 to 1, and radius there, in the order in which the surface is run through: a pipe
        goes to its mouth and back inside. The radius is 0 at the first and the last.
    sideways : array (3,)
        Unit normal of the plane.
    flat : float
        The radius across the plane, as a part of the radius within it.
    """
    given = np.asarray(stations, np.float64)
    run = np.linspace(0, 1, len(given))
    place, radius = PchipInterpolator(run, given)(np.linspace(0, 1, along)).T
    centre, direction = _at(smooth_curve(path, 400), np.clip(place, 0, 1))
    across = np.broadcast_to(np.asarray(sideways, np.float64), centre.shape)
    inwards = np.cross(across, direction)
    angle = 2 * np.pi * np.arange(around) / around
    ring = np.cos(angle)[:, None] * inwards[:, None] + flat * np.sin(angle)[:, None] * across[:, None]
    return tube(centre[:, None] + np.maximum(radius, 0)[:, None, None] * ring)


def _at(curve: FloatArray, place: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return points and unit directions of a curve, each (L, 3), at places 0 to 1 (L,)."""
    knots = np.linspace(0, 1, len(curve))
    spline = CubicSpline(knots, curve)
    return spline(place), normalised(spline(place, 1))
