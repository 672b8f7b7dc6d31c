"""Albedo of a rough surface over roughness, thickness scale, angle and wavelength, its means, and colours."""

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import NumericalError
from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.tiles import Observer, step_of
from nacreous.tables.albedo.certificate import certify
from nacreous.tables.albedo.refine import refined
from nacreous.tables.albedo.solver import (
    MEAN_ANGLES,
    AlbedoGeometry,
    AlbedoSolver,
    albedo_solver,
    check_albedo,
)
from nacreous.tables.colour import Colouring
from nacreous.tables.computed import (
    Computed,
    Step,
    asked_precision,
    axis,
    colouring_of,
    film_axes,
    grid_of,
    run,
)
from nacreous.tables.facet_film import cosine_weighted_nodes, on_facets
from nacreous.tables.film import Grid
from nacreous.tables.spec import Spec, roughness_values
from nacreous.tables.table import Part, Variable

__all__ = ["compute_albedo"]

_DIMS = ("roughness", "thickness_scale", "cos_theta", "wavelength_nm")
_MEAN_DIMS = ("roughness", "thickness_scale", "wavelength_nm")
_COLOUR_DIMS = ("roughness", "thickness_scale", "cos_theta", "channel")

_NAMES = {Side.REFLECTION: ("E_r", "reflected"), Side.TRANSMISSION: ("E_t", "transmitted")}
_LEAST, _MOST = -1e-5, 1 + 1.1e-3
"""Bounds of an albedo before clamping, the tolerance of `check_albedo` included."""


def compute_albedo(
    device: Device, spec: Spec, wanted: frozenset[Part], observer: Observer | None
) -> Computed:
    """Compute the `wanted` parts of an albedo table; raises what `tabulate_table` raises."""
    grid, roughness = grid_of(spec), roughness_values(spec)
    _require(spec, roughness, grid, wanted)
    solver = albedo_solver(device, spec)
    check_albedo(solver, roughness, grid)
    colouring = colouring_of(spec, solver.film.solver, on_facets(grid))
    if spec.accuracy.delta_e is not None and colouring is not None:
        roughness, grid = refined(solver, roughness, grid, colouring, spec.accuracy.delta_e)
    certificate = certify(solver, roughness, grid, colouring)
    task = _task(solver, roughness, grid, step_of(observer, 0, 2))
    variables = run(task.steps(wanted, colouring), asked_precision(spec), step_of(observer, 1, 2))
    coords = {
        **axis("roughness", roughness, "1", "roughness alpha, the mean sqrt(alpha_x alpha_y)"),
        **film_axes(grid, colouring),
    }
    return Computed(coords, variables, certificate, solver.film.solver.precision)


def _require(spec: Spec, roughness: NDArray[np.float64], grid: Grid, wanted: frozenset[Part]) -> None:
    """Count the table against the byte budget: products are taken in double precision."""
    numbers = 2 * grid.wavelength_nm.size if Part.SPECTRUM in wanted else 6
    shape = (roughness.size, grid.thickness_scale.size, grid.cos_theta.size)
    sizes = " x ".join(map(str, shape))
    item = np.dtype(asked_precision(spec).dtype).itemsize
    require(f"an albedo table of {sizes} x {numbers} numbers", int(np.prod(shape)) * numbers * (8 + item))


@dataclass(frozen=True, eq=False)
class _Task:
    """A table's geometry, and the film it is to be multiplied with."""

    solver: AlbedoSolver
    roughness: NDArray[np.float64]
    grid: Grid
    geometry: AlbedoGeometry
    mirror_mean: NDArray[np.float64]

    def steps(self, wanted: frozenset[Part], colouring: Colouring | None) -> list[Step]:
        """List what computes the wanted parts."""
        steps: list[Step] = []
        if Part.SPECTRUM in wanted:
            steps += [self._spectra, self._means]
        if Part.COLOUR in wanted and colouring is not None:
            steps += [partial(self._colour, colouring, side) for side in self.solver.sides]
        return steps

    def _spectra(self, observer: Observer | None) -> dict[str, Variable]:
        del observer  # one product
        return {
            _NAMES[side][0]: _variable(_NAMES[side][0], _DIMS, values, f"albedo of {_NAMES[side][1]} light")
            for side, values in self._products(self.geometry).items()
        }

    def _means(self, observer: Observer | None) -> dict[str, Variable]:
        mu, weights = cosine_weighted_nodes(MEAN_ANGLES)
        geometry = self.solver.geometry(self.roughness, mu, self.grid.wavelength_nm, observer)
        sides = self._products(geometry.mean(weights))
        variables = {}
        for side, values in sides.items():
            name, light = f"{_NAMES[side][0]}_mean", _NAMES[side][1]
            meaning = f"albedo of {light} light, its cosine-weighted mean over the angles"
            variables[name] = _variable(name, _MEAN_DIMS, values[:, :, 0], meaning)
        return variables

    def _products(self, geometry: AlbedoGeometry) -> dict[Side, NDArray[np.float64]]:
        return self.solver.spectra(
            geometry, self.mirror_mean, self.grid.thickness_scale, self.grid.wavelength_nm
        )

    def _colour(self, colouring: Colouring, side: Side, observer: Observer | None) -> dict[str, Variable]:
        del observer
        name, light = f"{_NAMES[side][0]}_rgb", _NAMES[side][1]
        scales = self.grid.thickness_scale
        colour = self.solver.colours(self.geometry, self.mirror_mean, scales, colouring, side)
        if not np.isfinite(colour).all():
            raise NumericalError(f"{name} has values that are not finite. Please report this spec.")
        return {name: Variable(_COLOUR_DIMS, colour, "1", f"linear colour of the {light} light's albedo")}


def _task(
    solver: AlbedoSolver, roughness: NDArray[np.float64], grid: Grid, observer: Observer | None
) -> _Task:
    geometry = solver.geometry(roughness, grid.cos_theta, grid.wavelength_nm, observer)
    return _Task(solver, roughness, grid, geometry, solver.mirror_mean(roughness))


def _variable(name: str, dims: tuple[str, ...], values: NDArray[np.float64], meaning: str) -> Variable:
    """Return an albedo within [0, 1]; raises `NumericalError` where rounding does not explain a value."""
    least, most = float(values.min()), float(values.max())
    if not (least >= _LEAST and most <= _MOST):  # False for NaN, too
        raise NumericalError(
            f"{name} lies in [{least:.9g}, {most:.9g}]; it must lie in [0, 1]. Please report this spec."
        )
    return Variable(dims, np.clip(values, 0, 1), "1", meaning)
