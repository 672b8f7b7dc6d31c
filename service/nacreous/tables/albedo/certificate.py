"""What an albedo table's numbers are worth: its errors, measured between the texels.

As for the film: linear interpolation in the middle of cells against the albedo itself, in double precision,
with twice the nodes and twice the facets each way. Cells are spread over the table; their number is stated. A
function that bends within a cell may be off by more elsewhere in it: a finer axis tells.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.tables.albedo.solver import AlbedoGeometry, AlbedoSolver
from nacreous.tables.cells import Cells, middle_of
from nacreous.tables.colour import Colouring
from nacreous.tables.colour_figures import NO_COLOUR_FIGURES, colour_figures, colours_apart
from nacreous.tables.figures import Figures
from nacreous.tables.film import Grid

__all__ = ["AlbedoCells", "AlbedoCertificate", "certify", "colour_differences"]

FloatArray = NDArray[np.float64]

_ROUGHNESS_CELLS, _SCALE_CELLS, _ANGLE_CELLS, _WAVELENGTH_CELLS = 6, 4, 24, 32


@dataclass(frozen=True)
class AlbedoCertificate(Figures):
    """Measured errors of a table of E_r and E_t.

    Parameters
    ----------
    held_out_points : int
        Points between the texels that E_r and E_t were compared at.
    albedo_error_max, albedo_error_p99 : float
        Largest difference, and the 99th percentile, of interpolated and exact E_r and E_t.
    texel_error_max : float
        The same without interpolation: what the facets, the nodes and the precision cost.
    film_error : float
        Largest error of R and T between the nodes that facets take them from.
    energy_max : float
        Largest E_r + E_t.
    nonfinite : int
        Values that are not finite.
    colour_cells : int
        Cells between the texels that colours were compared at.
    delta_e_max, delta_e_p99 : float or None
        CIEDE2000 of interpolated and exact colour; None where the wavelengths span no colour.
    out_of_gamut : float or None
        Share of colours with a component below 0 or above 1.
    quadrature_error : float or None
        Largest change of the film's linear colour on halving the steps that it is integrated with.
    """

    held_out_points: int
    albedo_error_max: float
    albedo_error_p99: float
    texel_error_max: float
    film_error: float
    energy_max: float
    nonfinite: int
    colour_cells: int
    delta_e_max: float | None
    delta_e_p99: float | None
    out_of_gamut: float | None
    quadrature_error: float | None


@dataclass(frozen=True, eq=False)
class AlbedoCells:
    """Cells over roughness, thickness scale and angle."""

    roughness: Cells
    thickness_scale: Cells
    cos_theta: Cells

    @property
    def count(self) -> int:
        """How many there are."""
        return self.roughness.lower.size * self.thickness_scale.lower.size * self.cos_theta.lower.size


def certify(
    solver: AlbedoSolver, roughness: FloatArray, grid: Grid, colouring: Colouring | None
) -> AlbedoCertificate:
    """Measure a table's errors on cells that are spread over it."""
    cells = AlbedoCells(
        Cells.along(roughness, _ROUGHNESS_CELLS),
        Cells.along(grid.thickness_scale, _SCALE_CELLS),
        Cells.along(grid.cos_theta, _ANGLE_CELLS),
    )
    waves = Cells.along(grid.wavelength_nm, _WAVELENGTH_CELLS)
    corners, middles = _Samples.at_corners(solver, cells, waves), _Samples.at_middles(solver, cells, waves)
    exact = _Samples.at_middles(solver.exact(), cells, waves)
    texels, truth = corners.spectra(waves.corners), exact.spectra(waves.middles)  # (sides, R, S, A, L)
    error = np.abs(middle_of(texels, 4) - truth)
    colour = NO_COLOUR_FIGURES if colouring is None else _colour_figures(corners, exact, colouring)
    return AlbedoCertificate(
        held_out_points=error[0].size,
        albedo_error_max=float(error.max()),
        albedo_error_p99=float(np.quantile(error, 0.99)),
        texel_error_max=float(np.abs(middles.spectra(waves.middles) - truth).max()),
        film_error=solver.film.error,
        energy_max=float(texels.sum(axis=0).max()),
        nonfinite=int(np.count_nonzero(~np.isfinite(texels))),
        colour_cells=0 if colouring is None else cells.count,
        **colour,
    )


def colour_differences(
    solver: AlbedoSolver, cells: AlbedoCells, grid: Grid, colouring: Colouring
) -> FloatArray:
    """CIEDE2000 amid cells of colours interpolated from their corners and computed there, (sides, …)."""
    waves = Cells(grid.wavelength_nm, grid.wavelength_nm)
    corners, middles = _Samples.at_corners(solver, cells, waves), _Samples.at_middles(solver, cells, waves)
    return _apart(corners.colours(colouring), middles.colours(colouring), colouring)


@dataclass(frozen=True, eq=False)
class _Samples:
    """The albedo at every combination of some roughnesses, scales and angles, each computed once.

    Neighbouring cells share their corners: `places` are those of the samples, (R,), (S,) and (A,), among the
    distinct values that the rest is for.
    """

    solver: AlbedoSolver
    geometry: AlbedoGeometry
    mirror_mean: FloatArray
    thickness_scale: FloatArray
    places: tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]

    @classmethod
    def at_corners(cls, solver: AlbedoSolver, cells: AlbedoCells, waves: Cells) -> "_Samples":
        axes = cells.roughness.corners, cells.thickness_scale.corners, cells.cos_theta.corners
        return cls._of(solver, *axes, waves)

    @classmethod
    def at_middles(cls, solver: AlbedoSolver, cells: AlbedoCells, waves: Cells) -> "_Samples":
        axes = cells.roughness.middles, cells.thickness_scale.middles, cells.cos_theta.middles
        return cls._of(solver, *axes, waves)

    @classmethod
    def _of(
        cls,
        solver: AlbedoSolver,
        roughness: FloatArray,
        thickness_scale: FloatArray,
        cos_theta: FloatArray,
        waves: Cells,
    ) -> "_Samples":
        axes = (roughness, thickness_scale, cos_theta)
        (alpha, r), (scale, s), (mu, a) = (np.unique(axis, return_inverse=True) for axis in axes)
        geometry = solver.geometry(alpha, mu, np.unique(waves.corners))
        return cls(solver, geometry, solver.mirror_mean(alpha), scale, (r, s, a))

    def _placed(self, distinct: FloatArray) -> FloatArray:
        """Values at the samples, (R, S, A, …), of those at the distinct ones."""
        values: FloatArray = distinct[np.ix_(*self.places)]
        return values

    def spectra(self, wavelength_nm: FloatArray) -> FloatArray:
        """E_r, and E_t where light is transmitted, (sides, R, S, A, L)."""
        sides = self.solver.spectra(self.geometry, self.mirror_mean, self.thickness_scale, wavelength_nm)
        return np.stack([self._placed(sides[side]) for side in self.solver.sides])

    def colours(self, colouring: Colouring) -> FloatArray:
        """Linear colours, (sides, R, S, A, 3)."""
        task = (self.geometry, self.mirror_mean, self.thickness_scale, colouring)
        return np.stack([self._placed(self.solver.colours(*task, side)) for side in self.solver.sides])


def _colour_figures(corners: _Samples, exact: _Samples, colouring: Colouring) -> dict[str, Any]:
    texels = corners.colours(colouring)
    return colour_figures(_apart(texels, exact.colours(colouring), colouring), texels, colouring)


def _apart(corners: FloatArray, middles: FloatArray, colouring: Colouring) -> FloatArray:
    return colours_apart(middle_of(corners, 3), middles, colouring.system)
