"""The one small table that every client reads, and what it must find there: clients/README.md in NumPy.

The pixels come from OpenImageIO and the axes from the file's own attributes, so that nothing of Nacreous
stands between a client and what it is compared with.
"""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

CONTRACT_SPEC: dict[str, Any] = {
    "name": "The table that every client reads",
    "stack": {
        "incident": "air",
        "substrate": {"n": 1.5},
        "layers": [{"material": {"n": 2.0}, "thickness_nm": 420}],
    },
    "table": {
        "wavelength_nm": {"start": 380, "stop": 780, "step": 10},
        "cos_theta": 17,
        "thickness_scale": {"start": 0.5, "stop": 1.5, "count": 9},
    },
}
"""The film of Wu & Zheng 2015, figure 3, from half to one and a half times as thick: R and T in every hue."""

POINTS = np.array(
    [
        (0.0, 0.5),
        (1.0, 0.5),
        (0.0, 1.5),
        (1.0, 1.5),
        (1.0, 1.0),
        (0.5, 1.0),
        (0.73, 0.61),
        (0.31, 1.37),
        (0.9, 1.07),
        (0.06, 0.93),
    ]
)
"""Places (cos_theta, thickness_scale) to read at: the corners, texel centres, and between them."""


@dataclass(frozen=True, eq=False)
class LookupTexture:
    """A lookup texture as any reader has it.

    Parameters
    ----------
    texels : float array, shape (H, W, 3)
    axis_x, axis_y : dict
        What ``nacreous:axis.x`` and ``nacreous:axis.y`` say.
    """

    texels: FloatArray
    axis_x: dict[str, Any]
    axis_y: dict[str, Any]

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read an EXR by OpenImageIO."""
        import OpenImageIO

        image = OpenImageIO.ImageInput.open(str(path))
        spec = image.spec()
        texels = np.asarray(image.read_image(OpenImageIO.FLOAT), np.float64).reshape(
            spec.height, spec.width, -1
        )
        image.close()
        axes = (json.loads(spec.getattribute(f"nacreous:axis.{side}")) for side in "xy")
        return cls(texels, next(axes), next(axes))

    def at(self, cos_theta: FloatArray, thickness_scale: FloatArray) -> FloatArray:
        """Linear colour at places (P,) of both axes, (P, 3): linear filtering, clamped at the edges."""
        x, y = _texel(self.axis_x, cos_theta), _texel(self.axis_y, thickness_scale)
        (left, right, across), (upper, lower, down) = (
            _neighbours(x, self.texels.shape[1]),
            _neighbours(y, self.texels.shape[0]),
        )
        across, down = across[:, None], down[:, None]
        above = (1 - across) * self.texels[upper, left] + across * self.texels[upper, right]
        below = (1 - across) * self.texels[lower, left] + across * self.texels[lower, right]
        return (1 - down) * above + down * below


def write_contract_table(folder: Path) -> Path:
    """Compute the table and write ``contract.exr`` and ``contract.transmission.exr``; return the first."""
    import nacreous

    table = nacreous.tabulate(CONTRACT_SPEC)
    return nacreous.write(table, folder / "contract.exr")[0]


def _texel(axis: dict[str, Any], value: FloatArray) -> FloatArray:
    """Place along an axis in texels, 0 at the first centre."""
    if axis["mapping"] == "explicit":
        return np.interp(value, axis["values"], np.arange(axis["count"]))
    first, last = axis["range"]
    x = np.zeros_like(value) if last == first else (value - first) / (last - first)
    return np.clip(x, 0, 1) * (axis["count"] - 1)


def _neighbours(texel: FloatArray, count: int) -> tuple[NDArray[np.int_], NDArray[np.int_], FloatArray]:
    lower = np.clip(np.floor(texel).astype(int), 0, count - 2)
    return lower, lower + 1, texel - lower
