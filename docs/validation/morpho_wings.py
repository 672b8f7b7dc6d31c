"""The paper's Morpho wings against what Vukusic measured on single scales.

P. Vukusic, J. R. Sambles, C. R. Lawrence and R. J. Wootton, Quantified interference and diffraction in single
Morpho butterfly scales, Proc. R. Soc. Lond. B 266, 1403-1411 (1999): the cuticle's index is 1.56 + 0.06i, and
single scales reflect up to 75 % of blue light. Thicknesses of ridges: Wu and Zheng 2015, figure 8.

Ridge and gap are equally thick, d. Each reflects in phase with the next where one period is half a wave,
(n + 1) d = wavelength / 2: Bragg's condition, which knows nothing of the kernels' recursion.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from figures.hue import lab
from validation.appearance import screen, shown
from validation.comparison import Comparison
from validation.drawing import FAINT, INK, dress, figure
from validation.film_colours import spectra
from validation.page import table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

RIDGES_NM = (80.0, 100.0, 120.0, 135.0)
PRESET_NM = 100.0
"""What scale 1 is in the preset paper/figure-8."""
CUTICLE_N = 1.56
MEASURED_R = 0.75
WAVELENGTH_NM = np.arange(350.0, 801.0)
RIDGE_PRESET, RIDGE_SCALE = "morpho-ridges", 1.15


@dataclass(frozen=True, eq=False)
class Wings:
    """Spectra at normal incidence, R of shape (wings, L), and that of ridges of finite width, (L,)."""

    R: FloatArray
    ridges_R: FloatArray

    @property
    def peak_nm(self) -> FloatArray:
        """Return where each wing reflects most."""
        return WAVELENGTH_NM[self.R.argmax(axis=1)]

    @property
    def rgb(self) -> FloatArray:
        """Return the colours under D65, (wings, 3)."""
        return self.R @ screen().weights(WAVELENGTH_NM).T


def bragg_nm(ridge_nm: float) -> float:
    """Return the wavelength that a period of one ridge and one gap, equally thick, is half of."""
    return 2 * (CUTICLE_N + 1) * ridge_nm


def measure() -> Wings:
    """Compute the spectra of the paper's four wings."""
    wings = spectra("paper/figure-8", [ridge / PRESET_NM for ridge in RIDGES_NM], WAVELENGTH_NM)
    return Wings(wings, spectra(RIDGE_PRESET, [1.0, RIDGE_SCALE], WAVELENGTH_NM)[-1])


def headline(wings: Wings) -> str:
    """Say how near the peaks are to Bragg's, and how high."""
    apart = max(abs(peak / bragg_nm(ridge) - 1) for ridge, peak, _, _ in _each(wings))
    return f"peaks within {100 * apart:.1f} %; R = {wings.R.max():.2f}, up to {MEASURED_R} measured"


def numbers(wings: Wings) -> str:
    """Say where each wing reflects most, and how much."""
    rows = [
        f"{ridge:.0f} | {peak:.0f} | {bragg_nm(ridge):.0f} | {100 * (peak / bragg_nm(ridge) - 1):+.1f} | "
        f"{most:.2f} | {lab(rgb).word}"
        for ridge, peak, most, rgb in zip(
            RIDGES_NM, wings.peak_nm, wings.R.max(axis=1), wings.rgb, strict=True
        )
    ]
    header = (
        "ridge, nm: | peak, nm: | 2 (n + 1) d, nm: | apart, %: | R at the peak: | colour at normal incidence"
    )
    ridges = (
        f"The preset `{RIDGE_PRESET}` at scale {RIDGE_SCALE:g}, whose ridges are as wide as the paper draws "
        f"them and uneven by 5 nm, has its peak at {WAVELENGTH_NM[wings.ridges_R.argmax()]:.0f} nm, with "
        f"R = {wings.ridges_R.max():.2f} there."
    )
    return f"{table(header, rows)}\n\n{ridges}"


def _each(wings: Wings) -> Iterator[tuple[float, float, float, FloatArray]]:
    """Yield ridge, peak, R there, and colour."""
    return zip(RIDGES_NM, wings.peak_nm, wings.R.max(axis=1), wings.rgb, strict=True)


def draw(wings: Wings) -> "Figure":
    """Draw the spectra in their own colours."""
    drawn = figure(4.0)
    axes = drawn.add_axes((0.075, 0.13, 0.9, 0.75))
    pixels = shown(wings.rgb, 0.55)
    for ridge, R, peak, pixel in zip(RIDGES_NM, wings.R, wings.peak_nm, pixels, strict=True):
        axes.fill_between(WAVELENGTH_NM, R, color=pixel, alpha=0.25, lw=0)
        axes.plot(WAVELENGTH_NM, R, color=pixel, lw=2.2)
        axes.text(peak, MEASURED_R + 0.012, f"{ridge:.0f} nm: {peak:.0f} nm", va="bottom", **_LABEL)
        axes.plot([bragg_nm(ridge)] * 2, [0, 0.025], color=INK, lw=1.1)
    axes.plot(WAVELENGTH_NM, wings.ridges_R, color=FAINT, lw=1.2, ls=(0, (4, 2)))
    _dress(axes)
    return drawn


_LABEL: dict[str, Any] = {"size": 8.5, "color": INK, "ha": "center"}
_RIGHT = {**_LABEL, "ha": "right"}


def _dress(axes: "Axes") -> None:
    dress(axes, "Four wings of figure 8 at normal incidence", "wavelength, nm", "reflectance R")
    axes.axhline(MEASURED_R, color=INK, lw=0.9, ls=(0, (1, 2)))
    axes.text(798, MEASURED_R + 0.012, "measured: up to 0.75", va="bottom", **_RIGHT)
    axes.text(416, 0.31, f"{RIDGE_PRESET},\nscale {RIDGE_SCALE:g}", va="center", **_RIGHT)
    axes.set_xlim(350, 800)
    axes.set_ylim(0, 0.82)


COMPARISON = Comparison(
    name="morpho-wings",
    title="Morpho wings",
    against="Bragg's condition, Vukusic et al. 1999",
    measure=measure,
    headline=headline,
    numbers=numbers,
    draw=draw,
    palette=128,
)
