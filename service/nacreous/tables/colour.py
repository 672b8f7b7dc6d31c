"""The colour of a film: which wavelengths it is integrated over, and lookup textures of it."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.optics.colour import ColourSystem
from nacreous.optics.stack import Stack, all_layers
from nacreous.tables.film import Grid, film_problem, optical_thickness_nm
from nacreous.tables.solver import FilmSolver, probe_of
from nacreous.tables.thickness_spread import one_thickness

__all__ = ["Colouring", "has_colour", "quadrature_nm", "settled_colouring"]

FloatArray = NDArray[np.float64]

VISIBLE_NM = (400.0, 700.0)
"""What the wavelengths of a spec must span for its tables to have a colour."""

SAMPLES_A_FRINGE = 8
_WIDEST_STEP_NM = 1.0
_MOST_SAMPLES = 65_536

SETTLED = 2e-4
"""Change of a linear colour on halving the steps of its quadrature at which they are fine enough."""
_PROBE_SCALES, _PROBE_ANGLES = 5, 17


@dataclass(frozen=True, eq=False)
class Colouring:
    """How a film's colour is integrated.

    Parameters
    ----------
    system : ColourSystem
    quadrature_nm : float array, shape (Q,)
    weights : float array, shape (3, Q)
    error : float
        Largest change of a linear component, at probes over the table, on halving the steps.
    """

    system: ColourSystem
    quadrature_nm: FloatArray
    weights: FloatArray
    error: float


def has_colour(wavelength_nm: FloatArray) -> bool:
    """Whether wavelengths span the visible range, so that a colour can be computed."""
    return bool(wavelength_nm[0] <= VISIBLE_NM[0] and wavelength_nm[-1] >= VISIBLE_NM[1])


def quadrature_nm(
    stack: Stack, largest_scale: float, wavelength_nm: FloatArray, system: ColourSystem
) -> FloatArray:
    """Wavelengths that resolve the film's colour, whatever spectral axis is stored, shape (Q,).

    The part of the spec's range that the observer sees, in equal steps of 1 nm at most and at least 8 samples
    a fringe. Fringes are lambda^2 / (2 n d) apart, n d the optical thickness of the whole coherent stack;
    that is taken at 400 nm, below which an eye sees next to nothing.

    Raises
    ------
    SpecError
        The film is so thick that its fringes cannot be resolved.
    """
    first = max(system.range_nm[0], wavelength_nm[0])
    last = min(system.range_nm[1], wavelength_nm[-1])
    fringe_nm = VISIBLE_NM[0] ** 2 / max(2 * _optical_thickness_nm(stack, largest_scale), 1e-3)
    step_nm = min(_WIDEST_STEP_NM, fringe_nm / SAMPLES_A_FRINGE)
    samples = int(np.ceil((last - first) / step_nm)) + 1
    if samples > _MOST_SAMPLES:
        raise SpecError(
            "stack.layers",
            f"fringes that {_MOST_SAMPLES:,} wavelengths resolve",
            f"fringes {fringe_nm:.2g} nm apart",
            "give a layer this thick coherent = false",
        )
    return np.linspace(first, last, samples)


def settled_colouring(solver: FilmSolver, grid: Grid, system: ColourSystem) -> Colouring:
    """Halve the quadrature's steps until colours no longer change: sharp resonances need more than 8 samples.

    Raises
    ------
    SpecError
        The film is so thick that its fringes cannot be resolved.
    """
    nm = quadrature_nm(solver.stack, float(grid.thickness_scale[-1]), grid.wavelength_nm, system)
    probe = probe_of(grid, (_PROBE_SCALES, _PROBE_ANGLES, 1))
    colours = _colours(solver, probe, system, nm)
    while True:
        finer_nm = np.linspace(nm[0], nm[-1], 2 * nm.size - 1)
        finer = _colours(solver, probe, system, finer_nm)
        error = float(np.abs(finer - colours).max())
        if error <= SETTLED or finer_nm.size > _MOST_SAMPLES:
            return Colouring(system, nm, system.weights(nm), error)
        nm, colours = finer_nm, finer


def _colours(solver: FilmSolver, probe: Grid, system: ColourSystem, nm: FloatArray) -> FloatArray:
    at = replace(probe, wavelength_nm=nm)
    return np.asarray(solver.colours(at, system.weights(nm), solver.sides))


def _optical_thickness_nm(stack: Stack, largest_scale: float) -> float:
    """Largest n d of the coherent layers together, every repeat counted, over the visible wavelengths."""
    layers = len(all_layers(stack))
    grid = Grid(np.array([largest_scale]), np.ones(1), np.linspace(*VISIBLE_NM, 31))
    problem = film_problem(stack, one_thickness(layers), grid)
    return float(optical_thickness_nm(problem).sum(axis=0).max())
