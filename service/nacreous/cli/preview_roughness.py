"""The roughness strip of a preview: the colour of a surface's albedo from smooth to rough."""

from typing import TYPE_CHECKING

import numpy as np

from nacreous.cli.preview_style import INK, dress, exposed, note
from nacreous.cli.preview_surface import STRIP_ANGLES, RoughTables
from nacreous.formats.srgb import encoded

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["draw_roughness"]

_ROUGHNESS = r"roughness, $\sqrt{\alpha_x \alpha_y}$"
_LEAST_HEIGHT = 0.01
"""Roughness that a strip of one row spans to either side."""


def draw_roughness(axes: "Axes", tables: RoughTables, exposure: int) -> None:
    """Draw the reflected albedo over angle and roughness, as bright as the swatch."""
    strip = tables.strip
    colours = np.asarray(strip.values("E_r_rgb"), np.float64)[:, 0, ::-1]  # (R, A, 3), head on first
    roughness = strip.values("roughness")
    first, last = float(roughness[0]), float(roughness[-1])
    if first == last:
        first, last = first - _LEAST_HEIGHT, last + _LEAST_HEIGHT
    edges = (0.0, float(STRIP_ANGLES[0]), first, last)
    picture = encoded(exposed(colours, exposure))
    axes.imshow(picture, origin="lower", aspect="auto", extent=edges, interpolation="bilinear")
    if first < tables.roughness < last:
        axes.axhline(tables.roughness, color="white", linewidth=2.2, alpha=0.55)
        axes.axhline(tables.roughness, color=INK, linewidth=0.9, linestyle=(0, (6, 4)))
    axes.set_xticks(range(0, 90, 15), [f"{angle}°" for angle in range(0, 90, 15)])
    dress(axes, "Albedo", "angle of incidence", _ROUGHNESS)
    note(axes, "dashed: the lobes'")
