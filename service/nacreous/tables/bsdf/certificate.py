"""What a BSDF table's numbers are worth: its errors, measured between the samples.

A lobe that is narrower than the grid cannot be interpolated, and the certificate says so: it compares
f cos_o, the light that goes to a direction, in the middle of cells over every axis.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.bsdf import Pairs
from nacreous.opencl.film_colour import Side
from nacreous.tables.bsdf.directions import DirectionGrid
from nacreous.tables.bsdf.solver import BsdfSolver
from nacreous.tables.cells import Cells, middle_of
from nacreous.tables.colour import Colouring
from nacreous.tables.colour_figures import NO_COLOUR_FIGURES, colour_figures, colours_apart
from nacreous.tables.figures import Figures

__all__ = ["BsdfCertificate", "certify"]

FloatArray = NDArray[np.float64]

_CELLS = {"roughness": 3, "phi_i": 2, "theta_i": 8, "theta_o": 16, "phi": 8, "wavelength": 8}
_DARK = 1e-3
"""Part of the largest value below which a relative difference says nothing."""


@dataclass(frozen=True)
class BsdfCertificate(Figures):
    """Measured errors of a table of f_r and f_t.

    Parameters
    ----------
    held_out_points : int
        Points between the samples that f_r and f_t were compared at.
    bsdf_error_max, bsdf_error_p99 : float
        Largest difference, and the 99th percentile, of interpolated and exact f cos_o, in 1 / sr.
    bsdf_max : float
        Largest f cos_o there and at the samples about them, in 1 / sr: what the errors are to be seen beside.
    sample_error_max : float
        Largest relative difference of a sample, what the precision and the nodes cost, where f cos_o is above
        a thousandth of its largest.
    film_error : float
        Largest error of R and T between the nodes that facets take them from.
    reciprocity_error_max : float
        Largest relative difference of f_r and f_r with its directions exchanged.
    energy_max : float
        Largest albedo E_r + E_t at the table's roughnesses.
    nonfinite : int
        Values that are not finite.
    delta_e_max, delta_e_p99 : float or None
        CIEDE2000 of interpolated and exact colour of pi f cos_o, that of a white diffuse surface at most 1;
        None where the wavelengths span no colour.
    out_of_gamut : float or None
        Share of colours with a component below 0.
    quadrature_error : float or None
        Largest change of the film's linear colour on halving the steps that it is integrated with.
    """

    held_out_points: int
    bsdf_error_max: float
    bsdf_error_p99: float
    bsdf_max: float
    sample_error_max: float
    film_error: float
    reciprocity_error_max: float
    energy_max: float
    nonfinite: int
    delta_e_max: float | None
    delta_e_p99: float | None
    out_of_gamut: float | None
    quadrature_error: float | None


def certify(
    solver: BsdfSolver,
    grid: DirectionGrid,
    wavelength_nm: FloatArray,
    colouring: Colouring | None,
    energy_max: float,
) -> BsdfCertificate:
    """Measure a table's errors on cells that are spread over it; at its roughnesses, which are not varied."""
    waves = Cells.along(wavelength_nm, _CELLS["wavelength"])
    cells = _DirectionCells.of(grid)
    sides = solver.sides(wavelength_nm)
    compared = [_compared(solver, cells, side, waves) for side in sides]
    errors, exact, relative, samples = (np.concatenate([c[k] for c in compared]) for k in range(4))
    largest = float(exact.max())
    seen = exact > _DARK * largest
    return BsdfCertificate(
        held_out_points=int(exact.size),
        bsdf_error_max=float(errors.max()),
        bsdf_error_p99=float(np.quantile(errors, 0.99)),
        bsdf_max=max(largest, float(samples.max())),
        sample_error_max=float(relative[seen].max()) if seen.any() else 0.0,
        film_error=solver.albedo.film.error,
        reciprocity_error_max=_reciprocity_error(solver, cells, waves),
        energy_max=energy_max,
        nonfinite=int(np.count_nonzero(~np.isfinite(errors))),
        **(NO_COLOUR_FIGURES if colouring is None else _colour_figures(solver, cells, sides, colouring)),
    )


@dataclass(frozen=True, eq=False)
class _DirectionCells:
    """Cells over phi_i, theta_i, theta_o and phi, at some roughnesses."""

    roughness: NDArray[np.int32]
    angles: tuple[Cells, Cells, Cells, Cells]

    @classmethod
    def of(cls, grid: DirectionGrid) -> "_DirectionCells":
        axes = {"phi_i": grid.phi_i, "theta_i": grid.theta_i, "theta_o": grid.theta_o, "phi": grid.phi}
        some = np.unique(np.linspace(0, grid.roughness.size - 1, _CELLS["roughness"]).round().astype(int))
        phi_i, theta_i, theta_o, phi = (Cells.along(axis, _CELLS[name]) for name, axis in axes.items())
        return cls(grid.roughness[some], (phi_i, theta_i, theta_o, phi))

    def corners(self) -> DirectionGrid:
        return DirectionGrid(self.roughness, *(cells.corners for cells in self.angles))

    def middles(self) -> DirectionGrid:
        return DirectionGrid(self.roughness, *(cells.middles for cells in self.angles))


def _compared(
    solver: BsdfSolver, cells: _DirectionCells, side: Side, waves: Cells
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Error of interpolation, exact f cos_o, relative error of samples, and f cos_o at corners, each flat."""
    corners, middles = cells.corners(), cells.middles()
    at_corners = corners.pairs(side)
    samples = np.asarray(solver.spectra(at_corners, side, waves.corners), np.float64)
    between = middle_of(samples.reshape(*corners.shape, -1), 5)
    pairs = middles.pairs(side)
    cos_o = np.abs(pairs.outgoing[:, 2:])
    exact = solver.exact().spectra(pairs, side, waves.middles)
    alike = solver.spectra(pairs, side, waves.middles)
    error = np.abs(between.reshape(exact.shape) - exact) * cos_o
    relative = np.abs(alike - exact) / np.maximum(exact, 1e-30)
    samples *= np.abs(at_corners.outgoing[:, 2:])
    values = (error, exact * cos_o, relative, samples)
    flat = (np.asarray(part, np.float64).ravel() for part in values)
    return next(flat), next(flat), next(flat), next(flat)


def _reciprocity_error(solver: BsdfSolver, cells: _DirectionCells, waves: Cells) -> float:
    pairs = cells.middles().pairs(Side.REFLECTION)
    swapped = replace(pairs, incoming=pairs.outgoing, outgoing=pairs.incoming)
    there, back = (solver.spectra(p, Side.REFLECTION, waves.middles) for p in (pairs, swapped))
    return float((np.abs(there - back) / np.maximum(np.maximum(there, back), 1e-30)).max())


def _colour_figures(
    solver: BsdfSolver, cells: _DirectionCells, sides: tuple[Side, ...], colouring: Colouring
) -> dict[str, Any]:
    compared = [_compared_colours(solver, cells, side, colouring) for side in sides]
    apart, samples = (np.concatenate([c[k] for c in compared]) for k in range(2))
    return colour_figures(apart, samples, colouring, brightest=np.inf)


def _compared_colours(
    solver: BsdfSolver, cells: _DirectionCells, side: Side, colouring: Colouring
) -> tuple[FloatArray, FloatArray]:
    """Differences in the middle of cells, flat, and colours at their corners, (N, 3)."""
    corners, pairs = cells.corners(), cells.middles().pairs(side)
    samples = np.asarray(solver.colours(corners.pairs(side), side, colouring), np.float64)
    between = middle_of(samples.reshape(*corners.shape, 3), 4)
    exact = solver.exact().colours(pairs, side, colouring)
    shown, truth = (_shown(np.reshape(colour, (-1, 3)), pairs) for colour in (between, exact))
    return colours_apart(shown, truth, colouring.system), samples


def _shown(colour: NDArray[np.floating], pairs: Pairs) -> FloatArray:
    """Colour of pi f cos_o, no brighter than white: a glint is white, whatever it is interpolated to."""
    bright = np.pi * colour * np.abs(pairs.outgoing[:, 2:])
    return np.asarray(bright / np.maximum(bright.max(axis=-1, keepdims=True), 1))
