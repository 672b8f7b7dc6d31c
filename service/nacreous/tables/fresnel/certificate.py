"""What a table's numbers are worth: its errors, measured between the texels.

A reader of the table interpolates it linearly. The certificate does the same at the middle of cells, where
linear interpolation is at its worst, and compares with the film itself in double precision there. All cells
of a small table are measured, of a large one some that are spread over all of it: their number is stated. The
texels at their corners are computed as the table's own are.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.tables.cells import Cells, middle_of
from nacreous.tables.colour import Colouring
from nacreous.tables.colour_figures import NO_COLOUR_FIGURES, colour_figures, colours_apart
from nacreous.tables.figures import Figures
from nacreous.tables.film import Grid
from nacreous.tables.solver import FilmSolver

__all__ = [
    "FresnelCertificate",
    "SpectralFigures",
    "all_colour_cells",
    "certify",
    "colour_cells",
    "colour_differences",
    "measure_spectra",
    "short_of_grazing",
]

FloatArray = NDArray[np.float64]

GRAZING = 0.02
"""Cosine below which colour differences are stated apart: within 1.2 degrees of grazing, where a diffuse
surface sends 4e-4 of its light, a film between equal media has resonances as narrow as one likes."""
_ALL_SPECTRAL_CELLS, _SPREAD_SPECTRAL_CELLS = 250_000, (8, 64, 32)
"""So many cells are all compared; of more, so many over thickness scale, angle and wavelength."""
_ALL_COLOUR_NUMBERS, _SPREAD_COLOUR_CELLS = 1_000_000, (32, 128)
"""Cells whose exact colours take so many spectral values are all compared; else so many over either axis."""
_MOST_GRAZING_CELLS = 8


@dataclass(frozen=True)
class SpectralFigures(Figures):
    """Measured errors of a table's R and T, by which the precision of the table is settled.

    Parameters
    ----------
    held_out_points : int
        Points between the texels that R and T were compared at.
    intensity_error_max, intensity_error_p99 : float
        Largest difference, and the 99th percentile, of interpolated and exact R_s, R_p, T_s and T_p.
    rounding_error_max : float
        The same at the texels: what the precision costs.
    energy_max : float
        Largest R + T of either polarisation; 1 without absorption.
    nonfinite : int
        Values that are not finite; a table with any is refused before it gets a certificate.
    """

    held_out_points: int
    intensity_error_max: float
    intensity_error_p99: float
    rounding_error_max: float
    energy_max: float
    nonfinite: int


@dataclass(frozen=True)
class FresnelCertificate(SpectralFigures):
    """Measured errors of a table of R and T, and of its colours.

    Parameters
    ----------
    colour_cells : int
        Cells between the texels that colours were compared at, short of grazing.
    delta_e_max, delta_e_p99 : float or None
        CIEDE2000 of interpolated and exact colour, short of grazing incidence (cosine 0.02); None where the
        wavelengths span no colour.
    delta_e_grazing : float or None
        The largest difference in the cells from there to grazing; None where there are none.
    out_of_gamut : float or None
        Share of texels with a component below 0 or above 1.
    quadrature_error : float or None
        Largest change of a linear colour on halving the steps that it is integrated with.
    """

    colour_cells: int
    delta_e_max: float | None
    delta_e_p99: float | None
    delta_e_grazing: float | None
    out_of_gamut: float | None
    quadrature_error: float | None


def measure_spectra(solver: FilmSolver, grid: Grid) -> SpectralFigures:
    """Measure the errors of R and T on a table's cells; raises `NumericalError`."""
    scales, angles, waves = _spectral_cells(grid)
    axes, positions = zip(*(cells.samples() for cells in (scales, angles, waves)), strict=True)
    samples = Grid(*axes)
    texels = _stacked(solver.intensities(samples))  # (4, S', A', L')
    rounding = np.abs(texels - _stacked(solver.exact_intensities(samples)))
    corners = texels[np.ix_(range(len(texels)), *positions)]  # (4, 2 S, 2 A, 2 L)
    middles = Grid(scales.middles, angles.middles, waves.middles)
    error = np.abs(middle_of(corners, 3) - _stacked(solver.exact_intensities(middles)))
    return SpectralFigures(
        held_out_points=error[0].size,
        intensity_error_max=float(error.max()),
        intensity_error_p99=float(np.quantile(error, 0.99)),
        rounding_error_max=float(rounding.max()),
        energy_max=float((texels[:2] + texels[2:]).max()),
        nonfinite=int(np.count_nonzero(~np.isfinite(texels))),
    )


def certify(
    spectra: SpectralFigures,
    solver: FilmSolver,
    grid: Grid,
    colouring: Colouring | None,
    table: FloatArray | None = None,
) -> FresnelCertificate:
    """Measure the errors of a table's colours, and say all of it.

    Parameters
    ----------
    spectra : SpectralFigures
    solver : FilmSolver
    grid : Grid
    colouring : Colouring, optional
        Without it there is no colour.
    table : float array, shape (sides, S, A, 3), optional
        The colours of the whole table; those about the cells are computed without it.
    """
    colour = _NO_COLOUR if colouring is None else _colour_figures(solver, grid, colouring, table)
    return FresnelCertificate(**vars(spectra), **colour)


def _spectral_cells(grid: Grid) -> tuple[Cells, Cells, Cells]:
    axes = (grid.thickness_scale, grid.cos_theta, grid.wavelength_nm)
    few = math.prod(axis.size for axis in axes) <= _ALL_SPECTRAL_CELLS
    most = tuple(axis.size for axis in axes) if few else _SPREAD_SPECTRAL_CELLS
    scales, angles, waves = (Cells.along(axis, count) for axis, count in zip(axes, most, strict=True))
    return scales, angles, waves


def colour_cells(grid: Grid, colouring: Colouring) -> tuple[Cells, Cells]:
    """Choose the cells over thickness scale and angle at which a colour table is measured."""
    texels = grid.thickness_scale.size * grid.cos_theta.size
    if texels * colouring.quadrature_nm.size <= _ALL_COLOUR_NUMBERS:
        return all_colour_cells(grid)
    scales = Cells.along(grid.thickness_scale, _SPREAD_COLOUR_CELLS[0])
    return scales, short_of_grazing(Cells.along(grid.cos_theta, _SPREAD_COLOUR_CELLS[1]))


def all_colour_cells(grid: Grid) -> tuple[Cells, Cells]:
    """Return every cell over thickness scale and angle, short of grazing."""
    scales = Cells.along(grid.thickness_scale, grid.thickness_scale.size)
    return scales, short_of_grazing(Cells.along(grid.cos_theta, grid.cos_theta.size))


def short_of_grazing(angles: Cells) -> Cells:
    """Return the cells whose middle lies above `GRAZING`; all of them where none does."""
    above = angles.middles >= GRAZING
    return angles.where(above) if above.any() else angles


def colour_differences(solver: FilmSolver, scales: Cells, angles: Cells, colouring: Colouring) -> FloatArray:
    """CIEDE2000 of interpolated and exact colour amid cells, of R and any T: (sides, S, A)."""
    return _differences(solver, scales, angles, colouring, _texels(solver, scales, angles, colouring))


def _differences(
    solver: FilmSolver, scales: Cells, angles: Cells, colouring: Colouring, texels: FloatArray
) -> FloatArray:
    amid = Grid(scales.middles, angles.middles, colouring.quadrature_nm)
    exact = solver.exact_colours(amid, colouring.weights, solver.sides)
    return colours_apart(middle_of(texels, 2), exact, colouring.system)


_NO_COLOUR: dict[str, Any] = {**NO_COLOUR_FIGURES, "colour_cells": 0, "delta_e_grazing": None}


def _colour_figures(
    solver: FilmSolver, grid: Grid, colouring: Colouring, table: FloatArray | None
) -> dict[str, Any]:
    def measured(scales: Cells, angles: Cells) -> tuple[FloatArray, FloatArray]:
        """Return differences amid cells, and the texels about them."""
        if table is None:
            texels = _texels(solver, scales, angles, colouring)
        else:
            at_scale = np.searchsorted(grid.thickness_scale, scales.corners)
            at_mu = np.searchsorted(grid.cos_theta, angles.corners)
            texels = table[:, at_scale][:, :, at_mu]
        return _differences(solver, scales, angles, colouring, texels), texels

    scales, angles = colour_cells(grid, colouring)
    differences, texels = measured(scales, angles)
    grazing = _grazing_cells(grid)
    return {
        **colour_figures(differences, texels, colouring),
        "colour_cells": scales.lower.size * angles.lower.size,
        "delta_e_grazing": None if grazing is None else float(measured(scales, grazing)[0].max()),
    }


def _grazing_cells(grid: Grid) -> Cells | None:
    """Return the first few cells beside grazing; None where there are none, or no others."""
    angles = Cells.along(grid.cos_theta, grid.cos_theta.size)
    grazing = angles.where(angles.middles < GRAZING)
    if grazing.lower.size in (0, angles.lower.size):
        return None
    return grazing.where(np.arange(grazing.lower.size) < _MOST_GRAZING_CELLS)


def _stacked(intensities: dict[str, NDArray[np.floating]]) -> FloatArray:
    return np.stack([np.asarray(values, np.float64) for values in intensities.values()])


def _texels(solver: FilmSolver, scales: Cells, angles: Cells, colouring: Colouring) -> FloatArray:
    """Colours at the cells' corners, as the table has them: (sides, 2 S, 2 A, 3)."""
    (scale, at_scale), (mu, at_mu) = scales.samples(), angles.samples()
    grid = Grid(scale, mu, colouring.quadrature_nm)
    colours = np.asarray(solver.colours(grid, colouring.weights, solver.sides), np.float64)
    return colours[:, at_scale][:, :, at_mu]
