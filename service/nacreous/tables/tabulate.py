"""From a spec to a table."""

from collections.abc import Callable, Collection
from dataclasses import replace
from functools import partial
from importlib.metadata import version
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import NumericalError, SpecError
from nacreous.opencl.device import Device, open_device
from nacreous.opencl.film_colour import Side
from nacreous.opencl.precision import Precision
from nacreous.opencl.sources import kernels_hash
from nacreous.opencl.tiles import Observer
from nacreous.optics.colour import colour_system
from nacreous.optics.stack import all_layers
from nacreous.tables.axes import cos_theta_values, thickness_scale_values, wavelength_values_nm
from nacreous.tables.certificate import Certificate, certify
from nacreous.tables.colour import VISIBLE_NM, Colouring, has_colour, settled_colouring
from nacreous.tables.film import Grid
from nacreous.tables.identity import table_id
from nacreous.tables.refine import refined
from nacreous.tables.solver import FilmSolver, film_solver
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part, Table, Variable

__all__ = ["Observer", "tabulate_table"]

_PRECISIONS = {"single": Precision.SINGLE, "double": Precision.DOUBLE}

SINGLE_TOLERANCE = 2e-5
"""Measured rounding of R and T above which a table is computed in double precision."""

_Step = Callable[[Observer | None], dict[str, Variable]]

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


def tabulate_table(
    spec: Spec, parts: Collection[Part] | None = None, *, observer: Observer | None = None
) -> Table:
    """Compute a table.

    Parameters
    ----------
    spec : Spec
    parts : collection of Part, optional
        What is computed; everything that the spec has, without it. A spec whose wavelengths do not span the
        visible has no colour.
    observer : callable, optional
        Told the fraction done; what it raises ends the work.

    Raises
    ------
    SpecError
        A material, a name or an axis of the spec cannot be used.
    BudgetError
        The table is larger than the byte budget; nothing has been allocated.
    DeviceError, NumericalError
    """
    device = open_device()
    grid = Grid(
        thickness_scale_values(spec.table.thickness_scale),
        cos_theta_values(spec.table.cos_theta),
        wavelength_values_nm(spec.table.wavelength_nm),
    )
    wanted = _wanted(parts, grid)
    _check_ellipsometry(spec)
    solver = film_solver(device, spec.stack, grid, _PRECISIONS[spec.accuracy.precision])
    colouring = _colouring(spec, solver, grid) if has_colour(grid.wavelength_nm) else None
    if spec.accuracy.delta_e is not None:
        grid = refined(solver, grid, _required(colouring), spec.accuracy.delta_e)
    solver, certificate = _certified(solver, grid, colouring)
    variables = _variables(spec, solver, grid, colouring, wanted, observer)
    return Table(spec, _coords(grid, colouring), variables, _provenance(spec, device, solver, certificate))


def _certified(solver: FilmSolver, grid: Grid, colouring: Colouring | None) -> tuple[FilmSolver, Certificate]:
    """Certify a table before it is computed, in double precision where single turns out to lose too much."""
    if solver.precision is Precision.SINGLE:
        try:
            certificate = certify(solver, grid, colouring)
        except NumericalError:
            certificate = None
        if certificate is not None and certificate.rounding_error_max <= SINGLE_TOLERANCE:
            return solver, certificate
    exact = replace(solver, precision=Precision.DOUBLE)
    return exact, certify(exact, grid, colouring)


def _wanted(parts: Collection[Part] | None, grid: Grid) -> frozenset[Part]:
    if parts is None:
        return frozenset(Part) if has_colour(grid.wavelength_nm) else frozenset({Part.SPECTRUM})
    if Part.COLOUR in parts and not has_colour(grid.wavelength_nm):
        raise _no_colour(grid)
    return frozenset(parts)


def _no_colour(grid: Grid) -> SpecError:
    expected = f"wavelengths that span {VISIBLE_NM[0]:g} to {VISIBLE_NM[1]:g} nm, for a colour"
    return SpecError(
        "table.wavelength_nm",
        expected,
        f"{grid.wavelength_nm[0]:g} to {grid.wavelength_nm[-1]:g} nm",
        "ask for a format without colours, such as npz or csv",
    )


def _required(colouring: Colouring | None) -> Colouring:
    if colouring is None:
        raise SpecError("accuracy.delta_e", "a table with a colour", "wavelengths that span none")
    return colouring


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


def _colouring(spec: Spec, solver: FilmSolver, grid: Grid) -> Colouring:
    system = colour_system(spec.colour.illuminant, spec.colour.observer, spec.colour.space)
    return settled_colouring(solver, grid, system)


def _variables(
    spec: Spec,
    solver: FilmSolver,
    grid: Grid,
    colouring: Colouring | None,
    wanted: frozenset[Part],
    observer: Observer | None,
) -> dict[str, Variable]:
    steps: list[_Step] = []
    if Part.SPECTRUM in wanted:
        steps.append(partial(_spectra, solver.intensities, grid, "1"))
    if Part.SPECTRUM in wanted and spec.table.ellipsometry:
        steps.append(partial(_spectra, solver.ellipsometry, grid, "rad"))
    if Part.COLOUR in wanted and colouring is not None:
        steps += [partial(_colour, solver, grid, colouring, side) for side in solver.sides]
    dtype = _PRECISIONS[spec.accuracy.precision].dtype
    variables: dict[str, Variable] = {}
    for done, step in enumerate(steps):
        for name, variable in step(_within(observer, done, len(steps))).items():
            variables[name] = replace(variable, values=variable.values.astype(dtype, copy=False))
    return variables


def _within(observer: Observer | None, done: int, steps: int) -> Observer | None:
    """Return an observer of one step among several."""
    return None if observer is None else lambda fraction: observer((done + fraction) / steps)


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


def _colour(
    solver: FilmSolver, grid: Grid, colouring: Colouring, side: Side, observer: Observer | None
) -> dict[str, Variable]:
    name, meaning = _COLOURS[side]
    integrated = Grid(grid.thickness_scale, grid.cos_theta, colouring.quadrature_nm)
    colour = solver.colour(integrated, colouring.weights, side, observer)
    return {name: Variable(_COLOUR_DIMS, colour, "1", meaning)}


def _coords(grid: Grid, colouring: Colouring | None) -> dict[str, Variable]:
    def axis(name: str, values: NDArray[Any], unit: str, meaning: str) -> Variable:
        return Variable((name,), values, unit, meaning)

    coords = {
        "thickness_scale": axis(
            "thickness_scale", grid.thickness_scale, "1", "factor on every layer's thickness"
        ),
        "cos_theta": axis("cos_theta", grid.cos_theta, "1", "cosine of the angle in the incident medium"),
        "wavelength_nm": axis("wavelength_nm", grid.wavelength_nm, "nm", "vacuum wavelength"),
    }
    if colouring is not None:
        channels = np.array(colouring.system.channels)
        coords["channel"] = axis("channel", channels, "", "component of the linear colour")
    return coords


def _provenance(spec: Spec, device: Device, solver: FilmSolver, certificate: Certificate) -> dict[str, str]:
    return {
        "id": table_id(spec),
        "version": version("nacreous"),
        "spec": spec.model_dump_json(),
        "certificate": certificate.to_json(),
        "precision": solver.precision.name.lower(),
        "device": f"{device.info.platform}, {device.info.name}, {device.info.version}",
        "kernels": kernels_hash(),
    }
