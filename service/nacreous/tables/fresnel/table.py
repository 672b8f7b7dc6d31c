"""R and T of a film over thickness scale, angle and wavelength, psi and Delta, and colours."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import NumericalError, SpecError
from nacreous.opencl.device import Device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.precision import Precision
from nacreous.opencl.tiles import Observer
from nacreous.optics.stack import all_layers
from nacreous.tables.colour import Colouring
from nacreous.tables.computed import (
    Computed,
    Step,
    asked_precision,
    colouring_of,
    film_axes,
    grid_of,
    run,
)
from nacreous.tables.film import SINGLE_TOLERANCE, Grid
from nacreous.tables.fresnel.certificate import SpectralFigures, certify, measure_spectra
from nacreous.tables.fresnel.refine import refined
from nacreous.tables.solver import FilmSolver, film_solver
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part, Variable

__all__ = ["compute_fresnel"]

_SPECTRAL_DIMS = ("thickness_scale", "cos_theta", "wavelength_nm")
_COLOUR_DIMS = ("thickness_scale", "cos_theta", "channel")

_MEANINGS = {
    "R_s": "reflectance, s polarised",
    "R_p": "reflectance, p polarised",
    "T_s": "transmittance into the substrate, s polarised",
    "T_p": "transmittance into the substrate, p polarised",
    "psi": "ellipsometric angle psi",
    "Delta": "ellipsometric angle Delta, tan(psi) exp(i Delta) = -r_p / r_s",
}
_COLOURS = {
    Side.REFLECTION: ("R_rgb", "linear colour of the unpolarised reflectance"),
    Side.TRANSMISSION: ("T_rgb", "linear colour of the unpolarised transmittance"),
}


def compute_fresnel(
    device: Device, spec: Spec, wanted: frozenset[Part], observer: Observer | None
) -> Computed:
    """Compute the `wanted` parts of a fresnel table; raises what `tabulate_table` raises."""
    _check_ellipsometry(spec)
    grid = grid_of(spec)
    solver = film_solver(device, spec.stack, grid, asked_precision(spec))
    colouring = colouring_of(spec, solver, grid)
    if spec.accuracy.delta_e is not None and colouring is not None:
        grid = refined(solver, grid, colouring, spec.accuracy.delta_e)
    solver, spectra = _settled(solver, grid)
    steps = _steps(spec, solver, grid, colouring, wanted)
    variables = run(steps, asked_precision(spec), observer)
    certificate = certify(spectra, solver, grid, colouring, _colours_of(variables))
    return Computed(film_axes(grid, colouring), variables, certificate, solver.precision)


def _check_ellipsometry(spec: Spec) -> None:
    """Refuse psi and Delta of an average of intensities, which has no phase."""
    averaged = any(not layer.coherent or layer.thickness_sigma_nm for layer in all_layers(spec.stack))
    if spec.table.ellipsometry and averaged:
        raise SpecError(
            "table.ellipsometry",
            "a film of coherent layers without thickness_sigma_nm",
            "one whose intensities are averaged, which has no phase",
            "leave ellipsometry out, or make the layers coherent and even",
        )


def _settled(solver: FilmSolver, grid: Grid) -> tuple[FilmSolver, SpectralFigures]:
    """Settle the precision before a table is computed: double where single turns out to lose too much."""
    if solver.precision is Precision.SINGLE:
        try:
            figures = measure_spectra(solver, grid)
        except NumericalError:
            figures = None
        if figures is not None and figures.rounding_error_max <= SINGLE_TOLERANCE:
            return solver, figures
    exact = replace(solver, precision=Precision.DOUBLE)
    return exact, measure_spectra(exact, grid)


def _colours_of(variables: Mapping[str, Variable]) -> NDArray[np.float64] | None:
    """Return the colours of a table, (sides, S, A, 3); None where none are wanted."""
    colours = [variables[name].values for name, _ in _COLOURS.values() if name in variables]
    return np.asarray(colours, np.float64) if colours else None


def _steps(
    spec: Spec, solver: FilmSolver, grid: Grid, colouring: Colouring | None, wanted: frozenset[Part]
) -> list[Step]:
    steps: list[Step] = []
    if Part.SPECTRUM in wanted:
        steps.append(partial(_spectra, solver.intensities, grid, "1"))
    if Part.SPECTRUM in wanted and spec.table.ellipsometry:
        steps.append(partial(_spectra, solver.ellipsometry, grid, "rad"))
    if Part.COLOUR in wanted and colouring is not None:
        steps.append(partial(_colours, solver, grid, colouring))
    return steps


def _spectra(
    compute: Callable[[Grid, Observer | None], dict[str, NDArray[np.floating]]],
    grid: Grid,
    unit: str,
    observer: Observer | None,
) -> dict[str, Variable]:
    return {
        name: Variable(_SPECTRAL_DIMS, values, unit, _MEANINGS[name])
        for name, values in compute(grid, observer).items()
    }


def _colours(
    solver: FilmSolver, grid: Grid, colouring: Colouring, observer: Observer | None
) -> dict[str, Variable]:
    integrated = Grid(grid.thickness_scale, grid.cos_theta, colouring.quadrature_nm)
    colours = solver.colours(integrated, colouring.weights, solver.sides, observer)
    of_sides = zip(solver.sides, colours, strict=True)
    return {
        name: Variable(_COLOUR_DIMS, colour, "1", meaning)
        for (name, meaning), colour in ((_COLOURS[side], colour) for side, colour in of_sides)
    }
