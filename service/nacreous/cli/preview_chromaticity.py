"""The chromaticity path of a preview: where a film's colour goes as angle and thickness change."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from nacreous.cli.preview_style import FAINT, INK
from nacreous.cli.preview_tables import PreviewTables
from nacreous.formats.srgb import encoded
from nacreous.optics.cie import colour_matching_functions
from nacreous.optics.colour import colour_system

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["draw_chromaticity"]

Array = NDArray[np.float64]

_DARKEST = 1e-4
"""Y below which a colour has no chromaticity worth drawing."""
_GAMUT = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06))
"""Primaries of sRGB and Rec.709 (ITU-R BT.709-6)."""
_WHITE = (0.3127, 0.3290)
_NAMED_NM = (450, 470, 480, 490, 500, 520, 540, 560, 580, 600, 620)


def draw_chromaticity(axes: "Axes", tables: PreviewTables) -> None:
    """Draw the paths over thickness, at normal incidence, and over angle, at scale 1, in CIE 1931 xy."""
    colours = np.asarray(tables.swatch.values("R_rgb"), np.float64)  # (H, W, 3), grazing first
    scales = tables.swatch.values("thickness_scale")
    at_scale_1 = int(np.argmin(np.abs(scales - 1)))
    _draw_diagram(axes)
    _draw_path(axes, colours[:, -1], 1.3)
    _draw_path(axes, colours[at_scale_1, ::-1], 3.4)
    start = _chromaticity(colours[at_scale_1, -1:])
    axes.plot(start[:, 0], start[:, 1], "o", markersize=6, color="white", markeredgecolor=INK, zorder=5)
    _dress(axes)


def _chromaticity(rgb: Array) -> Array:
    """Return CIE 1931 xy, shape (N, 2), of linear Rec.709 colours; NaN where they are black."""
    system = colour_system("D65", "CIE 1931 2 Degree Standard Observer", "Rec.709")
    xyz = system.to_xyz(rgb)
    total = np.where(xyz[:, 1] > _DARKEST, xyz.sum(axis=1), np.nan)
    return np.asarray(xyz[:, :2] / total[:, None])


def _draw_path(axes: "Axes", rgb: Array, width: float) -> None:
    """Draw a path whose every step has the colour it stands for, at equal brightness."""
    from matplotlib.collections import LineCollection

    xy = _chromaticity(rgb)
    brightest = np.maximum(rgb.max(axis=1, keepdims=True), 1e-9)
    steps = np.stack([xy[:-1], xy[1:]], axis=1)  # (N - 1, 2, 2)
    axes.add_collection(LineCollection(list(steps), colors=INK, linewidths=width + 1.1, capstyle="round"))
    shades = encoded(rgb / brightest)[:-1] / 255
    axes.add_collection(LineCollection(list(steps), colors=shades, linewidths=width, capstyle="round"))


def _draw_diagram(axes: "Axes") -> None:
    """Draw the spectral locus, the gamut of sRGB and its white."""
    wavelength_nm, observer = colour_matching_functions("CIE 1931 2 Degree Standard Observer")
    seen = (wavelength_nm >= 390) & (wavelength_nm <= 700)
    locus = (observer[:2] / observer.sum(axis=0))[:, seen].T  # (N, 2)
    axes.fill(*np.vstack([locus, locus[:1]]).T, facecolor="#f5f6f7", edgecolor=FAINT, linewidth=1)
    axes.fill(*np.transpose(_GAMUT), facecolor="white", edgecolor=FAINT, linewidth=0.8, linestyle="--")
    axes.plot(*_WHITE, "+", color=FAINT, markersize=8)
    for nm in _NAMED_NM:
        x, y = locus[int(np.argmin(np.abs(wavelength_nm[seen] - nm)))]
        outwards = np.array([x, y]) - _WHITE
        dx, dy = 11 * outwards / np.hypot(*outwards)
        style: dict[str, Any] = {"size": 7, "color": FAINT, "ha": "center", "va": "center"}
        axes.annotate(f"{nm}", (x, y), (dx, dy), textcoords="offset points", **style)


def _dress(axes: "Axes") -> None:
    axes.set_aspect("equal", adjustable="box")
    axes.set_anchor("W")
    axes.set_xlim(-0.09, 0.78)
    axes.set_ylim(-0.045, 0.89)
    axes.set_title("Chromaticity, CIE 1931", loc="left", size=12, color=INK, weight="bold", pad=8)
    axes.set_xlabel("x", color=INK)
    axes.set_ylabel("y", color=INK)
    axes.tick_params(colors=INK, labelsize=9)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_color(FAINT)
    notes = "thick line: over angle, at scale 1\nthin line: over thickness, head on\nring: scale 1, head on"
    notes += "\ncross: white; triangle: sRGB"
    axes.text(1.02, 0.98, notes, transform=axes.transAxes, size=9, color=FAINT, va="top", linespacing=1.7)
