"""Colours of wings over the angle: a strip for each thickness of their ridges."""

from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Sheet
from numpy.typing import NDArray
from PIL import Image

from figures.film_chart import picture_of
from figures.gamut import whitened
from figures.hue import lab
from figures.pictures import encoded

FloatArray = NDArray[np.float64]
FilmColours = Callable[[float, FloatArray], FloatArray]
"""Linear colours (A, 3) of a thickness in nm at angles in degrees (A,)."""

NAMED_DEG = (3.0, 14.0, 23.0, 33.0, 45.0, 58.0, 71.0)
DOTS_PER_INCH = 110


def wing_chart(
    thicknesses_nm: Sequence[float],
    theta_deg: FloatArray,
    film_colours: FilmColours,
    marked_deg: Sequence[float],
    width: int,
) -> Image.Image:
    """Draw strips of colour over the angle at the facets, with words for them, and mark some angles."""
    sheet = Sheet((width / DOTS_PER_INCH, 2.4), dpi=DOTS_PER_INCH, layout="constrained")
    axes = sheet.subplots(len(thicknesses_nm), 1, sharex=True)
    for axis, thickness in zip(axes, thicknesses_nm, strict=True):
        draw_strip(axis, theta_deg, film_colours(thickness, theta_deg))
        axis.set_ylabel(f"{thickness:.0f} nm", rotation=0, ha="right", va="center")
        for marked in marked_deg:
            axis.axvline(marked, color="white", linewidth=1.2, linestyle="--")
    axes[-1].set_xlabel("angle of incidence on the facets, degrees; dashed: as rendered above")
    return picture_of(sheet)


def draw_strip(axis: Axes, theta_deg: FloatArray, linear: FloatArray) -> None:
    """Draw linear colours (A, 3) over angles (A,), with words for them."""
    strip = encoded(whitened(linear))[None]
    axis.imshow(strip, extent=(theta_deg[0], theta_deg[-1], 0, 1), aspect="auto", interpolation="bilinear")
    for theta in NAMED_DEG:
        at = int(np.searchsorted(theta_deg, theta))
        ink = "white" if strip[0, at].mean() < 0.5 else "black"
        axis.text(theta, 0.5, lab(linear[at]).word, color=ink, ha="center", va="center", fontsize=9)
    axis.set_yticks([])
