"""A reader of measured materials, from the description of the format and its paper alone.

J. Dupuy and W. Jakob, "An adaptive parameterization for efficient material acquisition and rendering", ACM
TOG 37(6), 2018, section 5: f cos_o = S(s) ndf(m) / (4 sigma(i)), each table linear between its samples, and
s where the marginal and then the conditional distribution function of vndf have the facet m. Written for one
query at a time, by sums over whole rows, to share nothing with what it checks.
"""

import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

_TYPES = {1: "u1", 3: "<u2", 10: "<f4"}


def tensor_fields(path: Path) -> dict[str, NDArray[Any]]:
    """Return the fields of a tensor file by name."""
    data = path.read_bytes()
    assert data[:12] == b"tensor_file\0"
    assert data[12:14] == bytes([1, 0])
    fields, at = {}, 18
    for _ in range(struct.unpack_from("<I", data, 14)[0]):
        (length,) = struct.unpack_from("<H", data, at)
        name = data[at + 2 : at + 2 + length].decode()
        at += 2 + length
        ndim, code, offset = struct.unpack_from("<HBQ", data, at)
        shape = struct.unpack_from(f"<{ndim}Q", data, at + 11)
        at += 11 + 8 * ndim
        assert offset % 8 == 0
        fields[name] = np.frombuffer(data, _TYPES[code], int(np.prod(shape)), offset).reshape(shape)
    return fields


@dataclass(frozen=True, eq=False)
class MeasuredMaterial:
    """A material as its file has it."""

    fields: dict[str, NDArray[Any]]

    @classmethod
    def read(cls, path: Path) -> "MeasuredMaterial":
        """Read a file; each slice of vndf is a distribution, whatever its scale."""
        fields = tensor_fields(path)
        vndf = fields["vndf"].astype(np.float64)
        whole = np.array([[_whole(density) for density in row] for row in vndf])
        return cls({**fields, "vndf": vndf / whole[..., None, None]})

    def f_cos(self, i: FloatArray, o: FloatArray, channel: float) -> float:
        """F cos_o of one pair of unit vectors at a wavelength in nm, or of a component 0, 1 or 2."""
        h = (i + o) / np.linalg.norm(i + o)
        theta_i, phi_i = np.arccos(min(i[2], 1)), np.arctan2(i[1], i[0])
        theta_h, phi_h = np.arctan2(np.hypot(h[0], h[1]), h[2]), np.arctan2(h[1], h[0])
        isotropic = len(self.fields["phi_i"]) <= 2
        x, y = np.sqrt(2 * theta_h / np.pi), _turn(phi_h - phi_i if isotropic else phi_h)
        s = self._square(self._slice("vndf", phi_i, theta_i), x, y)
        stored = self._slice("spectra" if "spectra" in self.fields else "rgb", phi_i, theta_i)
        axis = self.fields.get("wavelengths", np.arange(3.0))
        place = np.interp(channel, axis, np.arange(len(axis)))
        lower = min(int(place), len(axis) - 2)
        plane = (1 - place + lower) * stored[lower] + (place - lower) * stored[lower + 1]
        ndf = _at(self.fields["ndf"], x, y)
        sigma = _at(self.fields["sigma"], np.sqrt(2 * theta_i / np.pi), _turn(phi_i))
        return float(_at(plane, *s) * ndf / (4 * sigma))

    def _slice(self, name: str, phi_i: float, theta_i: float) -> FloatArray:
        """Return a field at a direction of the incoming light, linear between its slices."""
        values, mean = self.fields[name], 0.0
        for q, around in enumerate(_weights(self.fields["phi_i"], phi_i)):
            for at, along in enumerate(_weights(self.fields["theta_i"], theta_i)):
                if around * along != 0:
                    mean = mean + around * along * values[q, at].astype(np.float64)
        return np.asarray(mean)

    @staticmethod
    def _square(density: FloatArray, x: float, y: float) -> tuple[float, float]:
        """Return the share of the density in rows before y, and along the row at y before x."""
        rows = np.linspace(0, 1, len(density))
        columns = np.linspace(0, 1, density.shape[1])
        at_y = np.array([np.interp(y, rows, column) for column in density.T])
        along = _integral(columns, at_y, x) / _integral(columns, at_y, 1)
        whole = np.array([_integral(columns, row, 1) for row in density])
        return along, _integral(rows, whole, y) / _integral(rows, whole, 1)


def _turn(phi: float) -> float:
    return (phi + np.pi) / (2 * np.pi) % 1


def _whole(density: FloatArray) -> float:
    return float(np.trapezoid(np.trapezoid(density, axis=1), axis=0)) / np.prod(np.array(density.shape) - 1)


def _integral(axis: FloatArray, values: FloatArray, upto: float) -> float:
    """Integral of what is linear between samples, from the first of the axis."""
    inside = axis < upto
    x = np.append(axis[inside], upto)
    return float(np.trapezoid(np.append(values[inside], np.interp(upto, axis, values)), x))


def _weights(axis: NDArray[Any], at: float) -> FloatArray:
    """Return the weight of each sample of an axis in a linear interpolation."""
    return np.array([np.interp(at, axis, unit) for unit in np.eye(len(axis))])


def _at(table: NDArray[Any], x: float, y: float) -> float:
    height, width = table.shape
    along = _weights(np.linspace(0, 1, width), x)
    return float(_weights(np.linspace(0, 1, height), y) @ (table.astype(np.float64) @ along))
