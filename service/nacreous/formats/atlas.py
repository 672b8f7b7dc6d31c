"""The atlas: where the axes of a table lie in a picture.

Two axes run inside a tile, x from left to right and y from the top row down, both ascending. Every texel is a
sample at the axis's own value, so the first and the last texel *centres* of a tile are the ends of the axis:
a shader reads at x (N - 1) + 0.5 texels from the tile's edge and never sees a neighbouring tile, with linear
filtering either. An axis of one value has two equal texels, so that it makes no difference whether a renderer
counts rows from the top or from the bottom.

The values of the other axes have a tile each, side by side or one below the other. Where several axes share a
direction, the last one changes fastest.

==========  ===========  ===============  ============  ====================
quantity    x            y                tiles across  tiles down
==========  ===========  ===============  ============  ====================
fresnel     cos_theta    thickness_scale  one           one
albedo      cos_theta    roughness        one           thickness_scale
bsdf        theta_o      theta_i          phi           roughness, any phi_i
==========  ===========  ===============  ============  ====================
"""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.tables.table import Table

__all__ = ["LAYOUTS", "Atlas", "Axis", "Layout", "atlas_of", "table_atlas"]


@dataclass(frozen=True)
class Layout:
    """Which axes of a quantity run where.

    Parameters
    ----------
    names : pair of str
        What the table calls the reflected and the transmitted part; a picture holds one of them.
    x, y : str
        Axes inside a tile.
    across, down : tuple of str
        Axes whose values have a tile each; those that a table does not have are left out.
    """

    names: tuple[str, str]
    x: str
    y: str
    across: tuple[str, ...] = ()
    down: tuple[str, ...] = ()


LAYOUTS: Mapping[str, Layout] = MappingProxyType(
    {
        "fresnel": Layout(("R", "T"), x="cos_theta", y="thickness_scale"),
        "albedo": Layout(("E_r", "E_t"), x="cos_theta", y="roughness", down=("thickness_scale",)),
        "bsdf": Layout(
            ("f_r", "f_t"), x="theta_o", y="theta_i", across=("phi",), down=("roughness", "phi_i")
        ),
    }
)
"""The layout of every quantity that a spec can ask for."""


@dataclass(frozen=True, eq=False)
class Axis:
    """An axis of a picture: its samples, shape (N,), and their unit."""

    name: str
    unit: str
    samples: NDArray[np.float64]

    @property
    def texels(self) -> NDArray[np.float64]:
        """Value of each texel; one sample has two."""
        return np.repeat(self.samples, 2) if len(self.samples) == 1 else self.samples

    def described(self) -> dict[str, Any]:
        """Return what ``nacreous:axis.x`` and ``nacreous:axis.y`` say, before it is JSON."""
        values = self.texels
        first, last = float(values[0]), float(values[-1])
        spaced = np.linspace(first, last, len(values))
        even = np.allclose(values, spaced, rtol=0, atol=1e-9 * max(abs(first), abs(last)))
        axis = {"name": self.name, "unit": self.unit, "range": [first, last], "count": len(values)}
        return axis | ({"mapping": "linear"} if even else {"mapping": "explicit", "values": values.tolist()})


@dataclass(frozen=True, eq=False)
class Atlas:
    """Where every sample of a table lies in a picture.

    Parameters
    ----------
    x, y : Axis
        Inside a tile.
    across, down : tuple of Axis
        Of the tiles; empty where there is one.
    """

    x: Axis
    y: Axis
    across: tuple[Axis, ...] = ()
    down: tuple[Axis, ...] = ()

    @property
    def rows(self) -> int:
        """Height of the picture in texels."""
        return _tiles(self.down) * len(self.y.texels)

    @property
    def columns(self) -> int:
        """Width of the picture in texels."""
        return _tiles(self.across) * len(self.x.texels)

    def picture(self, values: NDArray[Any], dims: Sequence[str]) -> NDArray[np.float32]:
        """Lay values out as float32 texels.

        Parameters
        ----------
        values : array
        dims : sequence of str
            Name of each axis of `values`: those of the atlas, and a last one whose values share a texel.

        Returns
        -------
        array, shape (rows, columns, C)
        """
        order = [axis.name for axis in (*self.down, self.y, *self.across, self.x)]
        texels = np.asarray(values, np.float32).transpose([*map(dims.index, order), len(dims) - 1])
        for axis in (self.x, self.y):
            if len(axis.samples) == 1:
                texels = np.repeat(texels, 2, axis=order.index(axis.name))
        return texels.reshape(self.rows, self.columns, -1)

    def described(self) -> dict[str, dict[str, Any]]:
        """Return what a picture's attributes say of its layout, before it is JSON."""
        tiled = {
            "tiles.x": _described_tiles(self.across, self.x),
            "tiles.y": _described_tiles(self.down, self.y),
        }
        inside = {"axis.x": self.x.described(), "axis.y": self.y.described()}
        return inside | {key: tiles for key, tiles in tiled.items() if tiles["axes"]}

    def attributes(self) -> dict[str, str]:
        """Return the attributes of a picture's layout, as JSON."""
        return {key: json.dumps(value) for key, value in self.described().items()}


def _tiles(axes: Sequence[Axis]) -> int:
    return math.prod(len(axis.samples) for axis in axes)


def _described_tiles(axes: Sequence[Axis], inside: Axis) -> dict[str, Any]:
    """Return the axes of the tiles in one direction, how many there are, and the texels of each."""
    named = [{"name": axis.name, "unit": axis.unit, "values": axis.samples.tolist()} for axis in axes]
    return {"axes": named, "count": _tiles(axes), "size": len(inside.texels)}


def atlas_of(quantity: str, axes: Mapping[str, Axis]) -> Atlas:
    """Return the atlas of a quantity over `axes`, which may hold others as well."""
    layout = LAYOUTS[quantity]
    across, down = (
        tuple(axes[name] for name in names if name in axes) for names in (layout.across, layout.down)
    )
    return Atlas(axes[layout.x], axes[layout.y], across, down)


def table_atlas(table: Table) -> Atlas:
    """Return the atlas of a table."""
    axes = {name: Axis(name, coord.unit, coord.values) for name, coord in table.coords.items()}
    return atlas_of(table.spec.table.quantity, axes)
