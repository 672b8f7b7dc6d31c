"""What a film of the paper does by itself: where its reflectance is largest, its colours over angle."""

from collections.abc import Iterator, Mapping

import numpy as np
import xarray
from numpy.typing import NDArray

import nacreous
from figures.hue import lab
from figures.tables import colours, spectra, table_at_angles
from nacreous import Spec

FloatArray = NDArray[np.float64]

STATED_ANGLES_DEG = np.array([0.0, 30.0, 45.0, 60.0, 75.0])


def maxima_by_formula(index: float, thickness_nm: float, first_nm: float, last_nm: float) -> FloatArray:
    """Return the wavelengths 4 n d / (2 m + 1) within a range, ascending.

    Of a film whose index is above those on both sides, at normal incidence: the first boundary turns the
    phase by half a period, the second does not (Born & Wolf 1999, 1.6.4).
    """
    order = np.arange(round(2 * index * thickness_nm / first_nm) + 1)
    wavelength = 4 * index * thickness_nm / (2 * order + 1)
    return np.sort(wavelength[(wavelength > first_nm) & (wavelength < last_nm)])


def maxima_of(table: xarray.Dataset) -> FloatArray:
    """Return where R of a table's first angle has maxima in wavelength: the tops of parabolas, in nm."""
    wavelength, r = np.asarray(table["wavelength_nm"], np.float64), spectra(table)[0]
    at = 1 + np.flatnonzero((r[1:-1] > r[:-2]) & (r[1:-1] >= r[2:]))
    below, top, above = r[at - 1], r[at], r[at + 1]
    return wavelength[at] + np.gradient(wavelength)[at] * (above - below) / (2 * (2 * top - below - above))


def normal_incidence(preset: str) -> xarray.Dataset:
    """Compute R of a preset in steps of 1 nm; the first angle is normal incidence."""
    return table_at_angles(nacreous.preset(preset), np.array([0.0, 1.0]), step_nm=1.0)


def maxima_lines(films: Mapping[str, tuple[str, float]], index: float) -> Iterator[str]:
    """Return a Markdown table of maxima; films are a preset and a thickness in nm by their names."""
    yield "| film | R of the table is largest at, nm | 4 n d / (2m + 1), nm |"
    yield "|---|---|---|"
    for name, (preset, thickness_nm) in films.items():
        table = normal_incidence(preset)
        formula = maxima_by_formula(index, thickness_nm, *np.asarray(table["wavelength_nm"])[[0, -1]])
        yield f"| {name} | {_joined(maxima_of(table))} | {_joined(formula)} |"


def colour_lines(films: Mapping[str, Spec], theta_deg: FloatArray = STATED_ANGLES_DEG) -> Iterator[str]:
    """Return a Markdown table of R over angle: linear colours of films by their names, and words for them."""
    yield "| angle of incidence | " + " | ".join(f"{name}: linear R, G, B | hue" for name in films) + " |"
    yield "|--:|" + "---|---|" * len(films)
    rgb = [colours(table_at_angles(spec, theta_deg)) for spec in films.values()]  # (films, A, 3)
    for theta, row in zip(theta_deg, zip(*rgb, strict=True), strict=True):
        yield f"| {theta:.0f}° | " + " | ".join(f"{_numbers(each)} | {lab(each)}" for each in row) + " |"


def share_of_red(spec: Spec, theta_deg: FloatArray) -> FloatArray:
    """Return R / (R + G + B) of the film's linear colours, (A,)."""
    rgb = colours(table_at_angles(spec, theta_deg))
    return rgb[:, 0] / rgb.sum(axis=1)


def _numbers(rgb: FloatArray) -> str:
    return ", ".join(f"{channel:.3f}" for channel in rgb)


def _joined(wavelength_nm: FloatArray) -> str:
    return ", ".join(f"{each:.1f}" for each in wavelength_nm)
