"""A chart of films: the colours of their reflected light over the angle, and their spectra."""

from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Sheet
from numpy.typing import NDArray
from PIL import Image

import nacreous
from figures.hue import lab
from figures.interference import maxima_by_formula, normal_incidence
from figures.pictures import encoded
from figures.tables import colours, spectra, table_at_angles

FloatArray = NDArray[np.float64]

ANGLES_DEG = np.linspace(0.0, 85.0, 171)
NAMED_DEG = (3.0, 30.0, 45.0, 60.0, 75.0)
STOPS = 1.5
"""Exposure of the strips: a film on glass reflects a fifth of white or less."""
LINE_COLOURS = ("#7a3b9a", "#1d8a5a", "#b8602a", "#2a62b8")
INCHES, DOTS_PER_INCH = (12.0, 5.6), 110


@dataclass(frozen=True)
class ShownFilm:
    """A film of a chart: its preset, and the layer that makes it."""

    label: str
    preset: str
    index: float
    thickness_nm: float


def film_chart(films: Sequence[ShownFilm]) -> Image.Image:
    """Draw strips of colour under each other, and the spectra at normal incidence below."""
    sheet = Sheet(INCHES, dpi=DOTS_PER_INCH, layout="constrained")
    axes = sheet.subplots(len(films) + 1, 1, height_ratios=[1.0] * len(films) + [2.6])
    for axis, film in zip(axes, films, strict=False):
        draw_strip(axis, film)
    axes[0].set_title(f"Colour of the reflected light, {STOPS:g} stops brighter, white light D65")
    axes[-2].set_xlabel("angle of incidence, degrees")
    draw_spectra(axes[-1], films)
    return picture_of(sheet)


def draw_strip(axis: Axes, film: ShownFilm) -> None:
    """Draw the colour over the angle, with words for it."""
    linear = colours(table_at_angles(nacreous.preset(film.preset), ANGLES_DEG))
    strip = encoded(2.0**STOPS * linear)[None]
    axis.imshow(strip, extent=(0, ANGLES_DEG[-1], 0, 1), aspect="auto", interpolation="bilinear")
    for theta in NAMED_DEG:
        at = np.searchsorted(ANGLES_DEG, theta)
        dark = strip[0, at].mean() < 0.55
        axis.text(
            theta, 0.5, lab(linear[at]).word, color="white" if dark else "black", ha="center", va="center"
        )
    axis.set_yticks([])
    axis.set_ylabel(film.label, rotation=0, ha="right", va="center")


def draw_spectra(axis: Axes, films: Sequence[ShownFilm]) -> None:
    """Draw R at normal incidence, and where 4 n d / (2 m + 1) says that it is largest."""
    for film, colour in zip(films, LINE_COLOURS, strict=False):
        table = normal_incidence(film.preset)
        wavelength = np.asarray(table["wavelength_nm"], np.float64)
        axis.plot(wavelength, spectra(table)[0], color=colour, label=film.label)
        for top in maxima_by_formula(film.index, film.thickness_nm, wavelength[0], wavelength[-1]):
            axis.axvline(top, color=colour, linestyle=":", linewidth=1)
    axis.set(xlim=(360, 830), ylim=(0, None), xlabel="wavelength, nm", ylabel="R at normal incidence")
    axis.set_title("Reflectance; dotted: 4 n d / (2m + 1)")
    axis.legend(loc="upper right", frameon=False)


def picture_of(sheet: Sheet) -> Image.Image:
    """Return a sheet of Matplotlib as a picture."""
    file = BytesIO()
    sheet.savefig(file, format="png")
    return Image.open(file).convert("RGB")
