"""A reader of MDL's measured BSDFs, from the description of the MDL SDK alone.

Lines of text: a first one that names the format, any metadata, and one before each block of numbers
(`bsdf_measurement.cpp`); three u32 for the type, 0 for one number a value and 1 for three, and the
resolutions of theta and phi; then floats at theta_in, theta_out and phi, phi fastest but for colours
(`ibsdf_isotropic_data.h`). They are the texels of a volume texture over [0, pi / 2]^2 x [0, pi], looked up
linearly with its outermost texels held, at |phi_out - phi_in| (`texture_support_cuda.h`).
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

BLOCKS = {b"MBSDF_DATA=": "reflection", b"MBSDF_DATA_REFLECTION=": "reflection"} | {
    b"MBSDF_DATA_TRANSMISSION=": "transmission"
}


def read_mbsdf(path: Path) -> "dict[str, MeasuredSide]":
    """Return the blocks of a file by side."""
    data = path.read_bytes()
    first, data = data.split(b"\n", 1)
    assert first == b"NVIDIA ARC MBSDF V1"
    sides = {}
    while data:
        line, data = data.split(b"\n", 1)
        if line in BLOCKS:
            kind, theta, phi = np.frombuffer(data, "<u4", 3).tolist()
            count = theta * theta * phi * (1, 3)[kind]
            values = np.frombuffer(data, "<f4", count, 12).astype(np.float64)
            sides[BLOCKS[line]] = MeasuredSide(values.reshape(theta, theta, phi, -1))
            data = data[12 + 4 * count :]
        else:
            assert not sides, "metadata after the numbers"
    return sides


@dataclass(frozen=True, eq=False)
class MeasuredSide:
    """One side of a file, (theta_in, theta_out, phi, colour)."""

    values: FloatArray

    def at(self, light: FloatArray, eye: FloatArray) -> FloatArray:
        """Return f, (colour,), of one pair of unit vectors."""
        angles = [np.arccos(abs(light[2])) / (np.pi / 2), np.arccos(abs(eye[2])) / (np.pi / 2)]
        turn = abs(np.arctan2(eye[1], eye[0]) - np.arctan2(light[1], light[0])) / np.pi
        found = self.values
        for at in (*angles, 2 - turn if turn > 1 else turn):
            found = _texel(found, at)
        return found


def _texel(texels: FloatArray, at: float) -> FloatArray:
    """Interpolate along the first axis, at a place of the unit interval."""
    place = np.clip(at * len(texels) - 0.5, 0, len(texels) - 1)
    lower = min(int(place), len(texels) - 2)
    return (1 - place + lower) * texels[lower] + (place - lower) * texels[lower + 1]
