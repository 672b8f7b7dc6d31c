"""The picture of ``nacreous preview``: drawn with matplotlib's objects, so that no state is shared."""

import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from nacreous.cli.preview_chromaticity import draw_chromaticity
from nacreous.cli.preview_lobe import LOBE_SCALE, draw_lobes
from nacreous.cli.preview_roughness import draw_roughness
from nacreous.cli.preview_style import FAINT, INK, dress, exposed, note
from nacreous.cli.preview_surface import RoughTables, surface_line
from nacreous.cli.preview_tables import SPECTRUM_ANGLES, PreviewTables
from nacreous.formats.atomic import replacing
from nacreous.formats.srgb import encoded, out_of_gamut
from nacreous.optics.stack import Group, Layer, Stack

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["draw"]

_WIDTH, _HEIGHT, _DPI = 12.0, 7.6, 160
"""Inches of the picture of a smooth film."""
_ROUGH_HEIGHT, _OPAQUE_HEIGHT = 3.6, 2.9
"""Inches that a rough surface adds below it, with and without a lobe of transmission."""
_LINES = ("#d1495b", "#edae49", "#2a9d8f", "#1d3f72")
"""One colour an angle, grazing first; told apart by colour-blind readers and by their lightness."""
_WIDEST_EXPOSURE = 5
_PAD_OVER_KEY = 26.0
"""Points between axes and their title with a row of keys between them."""
_KEY: dict[str, Any] = {
    "frameon": False,
    "ncols": 4,
    "fontsize": 9,
    "labelcolor": INK,
    "loc": "lower left",
    "bbox_to_anchor": (-0.02, 0.98),
    "handlelength": 1.6,
    "reverse": True,
}
"""The angles of the spectra, in one row above them."""


def draw(tables: PreviewTables, path: Path) -> None:
    """Draw a preview as PNG; raises `FileFormatError` where it cannot be written."""
    sheet = _Sheet(_surface_height(tables.rough))
    exposure = _exposure(tables)
    _draw_film(sheet, tables, exposure)
    if tables.rough is not None:
        _draw_surface(sheet, tables.rough, exposure)
    _draw_titles(sheet, tables, exposure)
    with replacing(path) as (temporary,), warnings.catch_warnings():
        # A letter that the font does not have is drawn as a box.
        warnings.filterwarnings("ignore", r"Glyph \d+", UserWarning)
        canvas = FigureCanvasAgg(sheet.figure)
        canvas.print_figure(temporary, format="png", metadata={"Software": None})


def _surface_height(rough: RoughTables | None) -> float:
    if rough is None:
        return 0.0
    return _ROUGH_HEIGHT if rough.transmits else _OPAQUE_HEIGHT


class _Sheet:
    """A figure whose upper part is the picture of a film, with `below` inches for a surface."""

    def __init__(self, below: float) -> None:
        self.below, self.height = below, _HEIGHT + below
        self.figure = Figure(figsize=(_WIDTH, self.height), dpi=_DPI, facecolor="white")

    def film(self, y: float) -> float:
        """Return where a height within the film's picture, 0 to 1, is on the sheet."""
        return (self.below + y * _HEIGHT) / self.height

    def inches(self, y: float) -> float:
        """Return where a height above the bottom, in inches, is on the sheet."""
        return y / self.height

    def line(self, y: float, text: str, **style: Any) -> None:  # noqa: ANN401 - matplotlib's own
        """Write a line of text at a height of the sheet; a name may hold a dollar sign."""
        self.figure.text(0.07, y, text, parse_math=False, **style)


def _draw_film(sheet: _Sheet, tables: PreviewTables, exposure: int) -> None:
    grid = sheet.figure.add_gridspec(
        2,
        2,
        width_ratios=(1.1, 1),
        height_ratios=(1, 1.42),
        left=0.07,
        right=0.975,
        top=sheet.film(0.83),
        bottom=sheet.film(0.125),
        hspace=0.42,
        wspace=0.19,
    )
    _draw_swatch(sheet.figure.add_subplot(grid[:, 0]), tables, exposure)
    _draw_spectrum(sheet.figure.add_subplot(grid[0, 1]), tables)
    draw_chromaticity(sheet.figure.add_subplot(grid[1, 1]), tables)


def _draw_surface(sheet: _Sheet, rough: RoughTables, exposure: int) -> None:
    """Draw three lobes and the roughness strip, under a line that says what the surface is."""
    heights = {"top": sheet.inches(sheet.below - 0.1), "bottom": sheet.inches(0.95)}
    left = sheet.figure.add_gridspec(1, 3, left=0.07, right=0.7, wspace=0.08, **heights)
    right = sheet.figure.add_gridspec(1, 1, left=0.765, right=0.975, **heights)
    draw_lobes([sheet.figure.add_subplot(left[0, column]) for column in range(3)], rough)
    draw_roughness(sheet.figure.add_subplot(right[0, 0]), rough, exposure)
    sheet.line(sheet.inches(sheet.below + 0.2), "Surface", size=12, weight="bold", color=INK)
    sheet.line(sheet.inches(sheet.below), surface_line(rough), size=10, color=FAINT)
    sheet.line(sheet.inches(0.6), LOBE_SCALE, size=8.5, color=FAINT)


def _draw_titles(sheet: _Sheet, tables: PreviewTables, exposure: int) -> None:
    spec = tables.spec
    colour = spec.colour
    name = " ".join(spec.name.split()) or "Film"
    sheet.line(sheet.film(0.94), _shortened(name, 60), size=19, weight="bold", color=INK)
    sheet.line(sheet.film(0.898), _shortened(_structure(spec.stack), 130), size=11, color=FAINT)
    notes = (
        f"{colour.illuminant}, {colour.observer}; shown in sRGB",
        f"exposure {exposure:+d} EV" if exposure else "exposure as computed",
        f"{out_of_gamut(_colours(tables)):.0%} of the swatch outside the gamut, clipped",
        f"table {tables.swatch.id[:12]}, Nacreous {tables.swatch.provenance['version']}",
    )
    sheet.line(sheet.inches(0.03 * _HEIGHT), "   ·   ".join(notes), size=8.5, color=FAINT)


def _shortened(text: str, most: int) -> str:
    return text if len(text) <= most else f"{text[: most - 1]}…"


def _structure(stack: Stack) -> str:
    """Return the stack on one line, from the incident medium inwards."""
    layers = [_entry(entry) for entry in stack.layers]
    shown = layers if len(layers) <= 5 else [*layers[:2], f"{len(layers) - 4} more", *layers[-2:]]
    return "  |  ".join([_material(stack.incident), *shown, _material(stack.substrate)])


def _entry(entry: Layer | Group) -> str:
    if isinstance(entry, Layer):
        return f"{entry.thickness_nm:g} nm of {_material(entry.material)}"
    return f"{entry.repeat} x ({' + '.join(map(_entry, entry.layers))})"


def _material(material: object) -> str:
    name = getattr(material, "name", None)
    if name is not None:
        return str(name)
    n, k = getattr(material, "n", None), getattr(material, "k", None)
    if isinstance(n, float):
        return f"n = {n:g} + {k:g}i" if k else f"n = {n:g}"
    return "mixture" if hasattr(material, "host") else "given n, k"


# ---- the swatch --------------------------------------------------------------------------------------------


def _colours(tables: PreviewTables) -> NDArray[np.float64]:
    return np.asarray(tables.swatch.values("R_rgb"), np.float64)  # (H, W, 3), grazing first


def _exposure(tables: PreviewTables) -> int:
    """Return the whole stops of light that bring the colours up to 60 degrees near white."""
    steep = _colours(tables)[:, tables.angles <= 60]
    bright = float(np.quantile(steep.max(axis=-1), 0.98))
    return int(np.clip(np.floor(np.log2(1 / max(bright, 1e-9))), 0, _WIDEST_EXPOSURE))


def _draw_swatch(axes: "Axes", tables: PreviewTables, exposure: int) -> None:
    picture = encoded(exposed(_colours(tables)[:, ::-1], exposure))  # normal incidence on the left
    scales = tables.swatch.values("thickness_scale")
    per_unit, label = _thickness_axis(tables.spec.stack)
    edges = (0.0, float(tables.angles[0]), float(scales[0]) * per_unit, float(scales[-1]) * per_unit)
    axes.imshow(picture, origin="lower", aspect="auto", extent=edges, interpolation="bilinear")
    axes.axhline(per_unit, color="white", linewidth=2.2, alpha=0.55)
    axes.axhline(per_unit, color=INK, linewidth=0.9, linestyle=(0, (6, 4)))
    axes.set_xticks(range(0, 90, 15), [f"{angle}°" for angle in range(0, 90, 15)])
    dress(axes, "Reflected colour", "angle of incidence", label)
    note(axes, "dashed: scale 1")


def _thickness_axis(stack: Stack) -> tuple[float, str]:
    """Return what a scale of 1 stands for on the axis, and the axis's label."""
    only = stack.layers[0]
    if len(stack.layers) == 1 and isinstance(only, Layer) and only.thickness_nm:
        return only.thickness_nm, "thickness of the film (nm)"
    return 1.0, "thickness scale of all layers"


# ---- the spectrum ------------------------------------------------------------------------------------------


def _draw_spectrum(axes: "Axes", tables: PreviewTables) -> None:
    wavelengths = tables.spectrum.values("wavelength_nm")
    R_s, R_p, T_s, T_p = (tables.spectrum.values(name)[0] for name in ("R_s", "R_p", "T_s", "T_p"))  # (A, L)
    for at, (angle, colour) in enumerate(zip(SPECTRUM_ANGLES, _LINES, strict=True)):
        R, T = (R_s[at] + R_p[at]) / 2, (T_s[at] + T_p[at]) / 2
        axes.fill_between(wavelengths, R_s[at], R_p[at], color=colour, alpha=0.12, linewidth=0)
        axes.plot(wavelengths, R, color=colour, linewidth=1.8, label=f"{angle:g}°")
        axes.plot(wavelengths, T, color=colour, linewidth=1.1, linestyle=(0, (4, 2)))
    axes.set_xlim(wavelengths[0], wavelengths[-1])
    axes.set_ylim(0, 1.02)
    axes.grid(axis="y", color="#e6e8eb", linewidth=0.8)
    axes.set_axisbelow(True)
    dress(axes, "Spectrum", "wavelength (nm)", "share of the light", pad=_PAD_OVER_KEY)
    note(axes, "solid R, band from s to p, dashed T", pad=_PAD_OVER_KEY)
    axes.legend(**_KEY)
