"""What every quantity computes: a grid, parts of it that were asked for, and what comes out."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.opencl.precision import Precision
from nacreous.opencl.tiles import Observer, step_of
from nacreous.optics.colour import colour_system
from nacreous.tables.axes import cos_theta_values, thickness_scale_values, wavelength_values_nm
from nacreous.tables.colour import VISIBLE_NM, Colouring, has_colour, settled_colouring
from nacreous.tables.figures import Figures
from nacreous.tables.film import Grid
from nacreous.tables.solver import FilmSolver
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part, Variable

__all__ = [
    "Computed",
    "asked_precision",
    "axis",
    "colouring_of",
    "film_axes",
    "grid_of",
    "run",
    "wanted_parts",
]

_PRECISIONS = {"single": Precision.SINGLE, "double": Precision.DOUBLE}

Step = Callable[[Observer | None], dict[str, Variable]]
"""Computes some variables of a table and tells the observer how far it is."""


@dataclass(frozen=True, eq=False)
class Computed:
    """A table but for its provenance: axes, variables, certificate, and the precision it was solved in."""

    coords: Mapping[str, Variable]
    variables: Mapping[str, Variable]
    certificate: Figures
    precision: Precision


def asked_precision(spec: Spec) -> Precision:
    """Return the precision that a spec asks for, in which its tables are stored."""
    return _PRECISIONS[spec.accuracy.precision]


def grid_of(spec: Spec) -> Grid:
    """Return the film's axes as a spec has them."""
    return Grid(
        thickness_scale_values(spec.table.thickness_scale),
        cos_theta_values(spec.table.cos_theta),
        wavelength_values_nm(spec.table.wavelength_nm),
    )


def wanted_parts(parts: Iterable[Part] | None, wavelength_nm: NDArray[np.float64]) -> frozenset[Part]:
    """Return what is computed: `parts`, or everything there is at these wavelengths.

    Raises
    ------
    SpecError
        A colour is wanted of wavelengths that do not span the visible.
    """
    coloured = has_colour(wavelength_nm)
    if parts is None:
        return frozenset(Part) if coloured else frozenset({Part.SPECTRUM})
    wanted = frozenset(parts)
    if Part.COLOUR in wanted and not coloured:
        raise SpecError(
            "table.wavelength_nm",
            f"wavelengths that span {VISIBLE_NM[0]:g} to {VISIBLE_NM[1]:g} nm, for a colour",
            f"{wavelength_nm[0]:g} to {wavelength_nm[-1]:g} nm",
            "ask for a format without colours, such as npz or csv",
        )
    return wanted


def colouring_of(spec: Spec, solver: FilmSolver, grid: Grid) -> Colouring | None:
    """Return how colours are integrated on a grid; None where its wavelengths span none.

    Raises
    ------
    SpecError
        An observer or an illuminant is unknown, or `[accuracy] delta_e` is wanted without a colour.
    """
    if has_colour(grid.wavelength_nm):
        system = colour_system(spec.colour.illuminant, spec.colour.observer, spec.colour.space)
        return settled_colouring(solver, grid, system)
    if spec.accuracy.delta_e is not None:
        raise SpecError("accuracy.delta_e", "a table with a colour", "wavelengths that span none")
    return None


def run(steps: list[Step], precision: Precision, observer: Observer | None) -> dict[str, Variable]:
    """Carry out steps one after the other, and return their variables in the precision of the table."""
    variables: dict[str, Variable] = {}
    for done, step in enumerate(steps):
        for name, variable in step(step_of(observer, done, len(steps))).items():
            variables[name] = replace(variable, values=variable.values.astype(precision.dtype, copy=False))
        if observer is not None:  # a step that is one product tells nothing by itself
            observer((done + 1) / len(steps))
    return variables


def axis(name: str, values: NDArray[Any], unit: str, meaning: str) -> dict[str, Variable]:
    """Return the coordinate `name`, which is its own dimension."""
    return {name: Variable((name,), values, unit, meaning)}


def film_axes(grid: Grid, colouring: Colouring | None) -> dict[str, Variable]:
    """Return the axes of thickness scale, angle and wavelength, and the channels of a colour."""
    return {
        **axis("thickness_scale", grid.thickness_scale, "1", "factor on every layer's thickness"),
        **axis("cos_theta", grid.cos_theta, "1", "cosine of the angle in the incident medium"),
        **spectral_axes(grid.wavelength_nm, colouring),
    }


def spectral_axes(wavelength_nm: NDArray[np.float64], colouring: Colouring | None) -> dict[str, Variable]:
    """Return the axis of wavelengths, and the channels of a colour."""
    wavelengths = axis("wavelength_nm", wavelength_nm, "nm", "vacuum wavelength")
    if colouring is None:
        return wavelengths
    channels = np.array(colouring.system.channels)
    return {**wavelengths, **axis("channel", channels, "", "component of the linear colour")}
