"""The lobes of a preview: where a rough surface sends its light, in the plane of incidence."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from nacreous.cli.preview_style import FAINT, INK
from nacreous.cli.preview_surface import LOBE_ANGLES, RoughTables
from nacreous.formats.srgb import encoded

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

__all__ = ["LOBE_SCALE", "draw_lobes"]

FloatArray = NDArray[np.float64]

LOBE_SCALE = "radius: f cos θ, logarithmic, a ring for a factor of 10; the outermost is the brightest of all"

_DECADES = 4
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""Y of linear Rec.709 (ITU-R BT.709-6)."""
_LARGEST, _BELOW = 1.12, 0.02
"""Half the width of a panel, and how far one without transmission goes below the surface, in radii."""


def draw_lobes(panels: "Sequence[Axes]", tables: RoughTables) -> None:
    """Draw a lobe for each angle of incidence, reflection up and any transmission down."""
    reflected, transmitted = (_profile(tables, name) for name in ("f_r_rgb", "f_t_rgb"))
    brightest = max(float((side @ _LUMINANCE).max()) for side in (reflected, transmitted) if side.size)
    for at, (axes, angle) in enumerate(zip(panels, LOBE_ANGLES, strict=True)):
        _draw_rings(axes)
        _draw_lobe(axes, _angles(tables), reflected[at], brightest)
        if transmitted.size:
            _draw_lobe(axes, np.pi - _angles(tables), transmitted[at], brightest)
        _draw_incidence(axes, angle)
        _dress(axes, angle, -_LARGEST if transmitted.size else -_BELOW)


def _angles(tables: RoughTables) -> FloatArray:
    """Return the angles of a profile in radians, (2 N,): the side that the light comes from is negative."""
    theta_o = tables.lobes.values("theta_o")
    return np.concatenate([-theta_o[::-1], theta_o])


def _profile(tables: RoughTables, name: str) -> FloatArray:
    """Return f cos_o in colour over `_angles`, (I, 2 N, 3); of no size where the table has none."""
    if name not in tables.lobes.variables:
        return np.empty((0, 0, 3))
    variable = tables.lobes.variables[name]
    at_one = {"roughness", "phi_i"} & set(variable.dims)
    f = variable.values.squeeze(tuple(variable.dims.index(dim) for dim in at_one))  # (I, O, phi, 3)
    lit = np.asarray(f, np.float64) * np.cos(tables.lobes.values("theta_o"))[:, None, None]
    behind, ahead = lit[:, :, 0], lit[:, :, 1]  # phi = 0 looks back along the light, phi = pi ahead
    return np.concatenate([behind[:, ::-1], ahead], axis=1)


def _radius(colours: FloatArray, brightest: float) -> FloatArray:
    """Return 1 for the brightest and 0 for what is `_DECADES` darker, or more."""
    least = brightest * 10.0**-_DECADES
    luminance = np.maximum(colours @ _LUMINANCE, least)
    return np.asarray(np.log10(luminance / least) / _DECADES)


def _draw_lobe(axes: "Axes", angles: FloatArray, colours: FloatArray, brightest: float) -> None:
    """Draw a lobe whose every direction has its colour, at equal brightness; angles from the normal up."""
    from matplotlib.collections import PolyCollection

    radius = _radius(colours, brightest)
    outline = radius[:, None] * np.stack([np.sin(angles), np.cos(angles)], axis=-1)  # (2 N, 2)
    wedges = np.stack([np.zeros_like(outline[:-1]), outline[:-1], outline[1:]], axis=1)
    shades = encoded(colours / np.maximum(colours.max(axis=-1, keepdims=True), 1e-12))[:-1] / 255
    axes.add_collection(PolyCollection(list(wedges), facecolors=shades, edgecolors=shades, linewidths=0.4))
    axes.plot(outline[:, 0], outline[:, 1], color=INK, linewidth=0.9)


def _draw_rings(axes: "Axes") -> None:
    turn = np.linspace(0, 2 * np.pi, 181)
    for ring in range(1, _DECADES + 1):
        r = ring / _DECADES
        axes.plot(r * np.cos(turn), r * np.sin(turn), color="#e6e8eb", linewidth=0.8, zorder=0)
    axes.plot([0, 0], [-_LARGEST, _LARGEST], color="#e6e8eb", linewidth=0.8, zorder=0)


def _draw_incidence(axes: "Axes", angle: float) -> None:
    """Draw the surface, and the light that falls on it."""
    from_left = np.array([-np.sin(np.deg2rad(angle)), np.cos(np.deg2rad(angle))])
    arrow: dict[str, Any] = {"arrowstyle": "-|>", "color": INK, "linewidth": 1.1, "shrinkA": 0, "shrinkB": 0}
    axes.plot([-_LARGEST, _LARGEST], [0, 0], color=INK, linewidth=1.4, zorder=3)
    head, tail = (tuple((radius * from_left).tolist()) for radius in (0.78, 1.1))
    axes.annotate("", head, tail, arrowprops=arrow, zorder=4)


def _dress(axes: "Axes", angle: float, lowest: float) -> None:
    axes.set_aspect("equal", adjustable="box")
    axes.set_anchor("N")
    axes.set_xlim(-_LARGEST, _LARGEST)
    axes.set_ylim(lowest, _LARGEST)
    axes.set_axis_off()
    style: dict[str, Any] = {"ha": "right", "clip_on": True}
    axes.text(_LARGEST, 0.98, f"{angle:g}°", size=11, color=INK, weight="bold", va="top", **style)
    axes.text(_LARGEST, 0.04, "R", size=8.5, color=FAINT, va="bottom", **style)
    axes.text(_LARGEST, -0.04, "T", size=8.5, color=FAINT, va="top", **style)
