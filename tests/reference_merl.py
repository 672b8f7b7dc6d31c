"""A reader of the MERL database, from its description alone.

W. Matusik, H. Pfister, M. Brand and L. McMillan, "A data-driven reflectance model", ACM TOG 22(3), 2003, and
the database's own notes on its files: three integers, then planes of doubles for red, green and blue to be
scaled by 1 / 1500, 1.15 / 1500 and 1.66 / 1500; bins of theta_h (by its square root), theta_d and phi_d (half
a turn), the last fastest; a negative number is no value. Half and difference angles by S. Rusinkiewicz 1998:
the half vector is turned to the pole, and the light with it. One query at a time.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

SCALES = np.array([1 / 1500, 1.15 / 1500, 1.66 / 1500])


def about_z(angle: float) -> FloatArray:
    """Return the matrix that turns about the normal."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def about_y(angle: float) -> FloatArray:
    """Return the matrix that turns the pole towards x."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def polar(vector: FloatArray) -> tuple[float, float]:
    """Return theta and phi of a unit vector."""
    return float(np.arctan2(np.hypot(*vector[:2]), vector[2])), float(np.arctan2(vector[1], vector[0]))


def half_and_difference(i: FloatArray, o: FloatArray) -> tuple[float, float, float]:
    """Return theta_h, theta_d and phi_d of two directions."""
    theta_h, phi_h = polar((i + o) / np.linalg.norm(i + o))
    return theta_h, *polar(about_y(-theta_h) @ about_z(-phi_h) @ i)


def directions_at(theta_h: float, theta_d: float, phi_d: float, turn: float) -> tuple[FloatArray, FloatArray]:
    """Return two directions with these angles, their half vector at the azimuth `turn`."""
    frame = about_z(turn) @ about_y(theta_h)
    light = np.array([np.sin(theta_d) * np.cos(phi_d), np.sin(theta_d) * np.sin(phi_d), np.cos(theta_d)])
    return frame @ light, frame @ (light * [-1, -1, 1])


@dataclass(frozen=True, eq=False)
class MerlMaterial:
    """A material as its file has it, (3, 90, 90, 180) in 1 / sr; below 0 is no value."""

    f: FloatArray

    @classmethod
    def read(cls, path: Path) -> "MerlMaterial":
        """Read a file, all of it: nothing may follow the planes."""
        with path.open("rb") as file:
            dims = np.fromfile(file, np.int32, 3)
            values = np.fromfile(file, np.float64, -1)
        return cls(values.reshape(3, *dims) * SCALES[:, None, None, None])

    def at(self, i: FloatArray, o: FloatArray) -> FloatArray:
        """Return red, green and blue of f for two directions, those of the bin they are in."""
        theta_h, theta_d, phi_d = half_and_difference(i, o)
        if phi_d < 0:
            phi_d += np.pi
        along = (np.sqrt(theta_h / (np.pi / 2)), theta_d / (np.pi / 2), phi_d / np.pi)
        bins = [min(int(at * n), n - 1) for at, n in zip(along, self.f.shape[1:], strict=True)]
        return self.f[:, *bins]
