"""f_r and f_t of a rough surface over roughness, directions and wavelength, and their colours."""

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import NumericalError
from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.tiles import Observer
from nacreous.tables.albedo.solver import check_albedo
from nacreous.tables.bsdf.certificate import certify
from nacreous.tables.bsdf.directions import DirectionGrid
from nacreous.tables.bsdf.solver import BsdfSolver, bsdf_solver
from nacreous.tables.colour import Colouring
from nacreous.tables.computed import (
    Computed,
    Step,
    asked_precision,
    axis,
    colouring_of,
    grid_of,
    run,
    spectral_axes,
)
from nacreous.tables.facet_film import on_facets
from nacreous.tables.spec import Spec, bsdf_angles, surface_of
from nacreous.tables.table import Part, Variable

__all__ = ["compute_bsdf"]

FloatArray = NDArray[np.float64]

_NAMES = {
    Side.REFLECTION: ("f_r", "reflected light"),
    Side.TRANSMISSION: ("f_t", "transmitted light, f cos_o a share of the flux"),
}
_PAIR_BYTES = 7 * 8
"""Bytes of the host for a pair of directions and its roughness."""


def compute_bsdf(device: Device, spec: Spec, wanted: frozenset[Part], observer: Observer | None) -> Computed:
    """Compute the `wanted` parts of a bsdf table; raises what `tabulate_table` raises."""
    grid = grid_of(spec)
    solver = bsdf_solver(device, spec)
    directions = _directions(spec, solver)
    _require(spec, directions, grid.wavelength_nm, wanted)
    energy_max = check_albedo(solver.albedo, solver.roughness, grid)
    colouring = colouring_of(spec, solver.albedo.film.solver, on_facets(grid))
    certificate = certify(solver, directions, grid.wavelength_nm, colouring, energy_max)
    task = _Task(solver, directions, grid.wavelength_nm, colouring, surface_of(spec).anisotropic)
    variables = run(task.steps(wanted), asked_precision(spec), observer)
    coords = {**_direction_axes(spec, solver.roughness), **spectral_axes(grid.wavelength_nm, colouring)}
    return Computed(coords, variables, certificate, solver.albedo.film.solver.precision)


def _directions(spec: Spec, solver: BsdfSolver) -> DirectionGrid:
    angles = bsdf_angles(spec)
    places = np.arange(solver.roughness.size, dtype=np.int32)
    return DirectionGrid(places, angles.phi_i, angles.theta_i, angles.theta_o, angles.phi)


def _require(
    spec: Spec, directions: DirectionGrid, wavelength_nm: FloatArray, wanted: frozenset[Part]
) -> None:
    numbers = wavelength_nm.size if Part.SPECTRUM in wanted else 3
    sizes = " x ".join(map(str, directions.shape))
    bytes_a_row = 2 * numbers * np.dtype(asked_precision(spec).dtype).itemsize + _PAIR_BYTES
    require(f"a bsdf table of {sizes} x {2 * numbers} numbers", int(np.prod(directions.shape)) * bytes_a_row)


def _direction_axes(spec: Spec, roughness: FloatArray) -> dict[str, Variable]:
    angles = bsdf_angles(spec)
    around = axis("phi_i", angles.phi_i, "rad", "azimuth of the incoming light, from x")
    return {
        **axis("roughness", roughness, "1", "roughness alpha, the mean sqrt(alpha_x alpha_y)"),
        **(around if surface_of(spec).anisotropic else {}),
        **axis("theta_i", angles.theta_i, "rad", "angle of the incoming light to the normal"),
        **axis("theta_o", angles.theta_o, "rad", "angle of the outgoing light to the normal, on its side"),
        **axis("phi", angles.phi, "rad", "azimuth of the outgoing light, from that of the incoming"),
    }


@dataclass(frozen=True, eq=False)
class _Task:
    """A table's directions, and what is computed at them."""

    solver: BsdfSolver
    directions: DirectionGrid
    wavelength_nm: FloatArray
    colouring: Colouring | None
    anisotropic: bool

    def steps(self, wanted: frozenset[Part]) -> list[Step]:
        """List what computes the wanted parts."""
        sides = self.solver.sides(self.wavelength_nm)
        steps: list[Step] = []
        if Part.SPECTRUM in wanted:
            steps += [partial(self._spectra, side) for side in sides]
            if Side.TRANSMISSION not in sides:
                steps.append(self._nothing_transmitted)
        if Part.COLOUR in wanted and self.colouring is not None:
            steps += [partial(self._colours, self.colouring, side) for side in sides]
        return steps

    @property
    def _dims(self) -> tuple[str, ...]:
        around = ("phi_i",) if self.anisotropic else ()
        return ("roughness", *around, "theta_i", "theta_o", "phi")

    @property
    def _shape(self) -> tuple[int, ...]:
        roughness, phi_i, *rest = self.directions.shape
        return (roughness, phi_i, *rest) if self.anisotropic else (roughness, *rest)

    def _spectra(self, side: Side, observer: Observer | None) -> dict[str, Variable]:
        name, light = _NAMES[side]
        f = self.solver.spectra(self.directions.pairs(side), side, self.wavelength_nm, observer)
        dims = (*self._dims, "wavelength_nm")
        return {name: Variable(dims, self._checked(name, f), "1/sr", f"BSDF of {light}")}

    def _nothing_transmitted(self, observer: Observer | None) -> dict[str, Variable]:
        del observer
        nothing = np.zeros((*self._shape, self.wavelength_nm.size), np.float32)
        meaning = "BSDF of transmitted light: none is scattered (opaque substrate, equal media, or phong)"
        return {"f_t": Variable((*self._dims, "wavelength_nm"), nothing, "1/sr", meaning)}

    def _colours(self, colouring: Colouring, side: Side, observer: Observer | None) -> dict[str, Variable]:
        name, light = f"{_NAMES[side][0]}_rgb", _NAMES[side][1]
        colour = self.solver.colours(self.directions.pairs(side), side, colouring, observer)
        dims = (*self._dims, "channel")
        return {
            name: Variable(dims, self._finite(name, colour), "1/sr", f"linear colour of the BSDF of {light}")
        }

    def _checked(self, name: str, f: NDArray[np.floating]) -> NDArray[np.floating]:
        if not f.min() >= 0:  # False for NaN, too
            raise NumericalError(f"{name} has values below 0 or none at all. Please report this spec.")
        return self._finite(name, f)

    def _finite(self, name: str, f: NDArray[np.floating]) -> NDArray[np.floating]:
        if not np.isfinite(f).all():
            raise NumericalError(f"{name} has values that are not finite. Please report this spec.")
        return f.reshape(*self._shape, -1)
