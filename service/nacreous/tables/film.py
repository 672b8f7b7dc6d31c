"""A spec's film as a problem for the kernels, and its R and T, checked.

A film is solved in the precision asked for, and in double precision wherever a coherent phase is so large
that single precision would lose it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import NumericalError
from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.film import film_intensities
from nacreous.opencl.film_problem import THICK, FilmProblem, Segment
from nacreous.opencl.precision import Precision
from nacreous.opencl.tiles import Observer
from nacreous.optics.stack import SampledStack, Stack, sample_stack
from nacreous.tables.thickness_spread import ThicknessSpread

__all__ = [
    "SINGLE_TOLERANCE",
    "Grid",
    "checked_intensities",
    "film_problem",
    "optical_thickness_nm",
    "phase_precision",
    "problem_of",
    "segments",
]

FloatArray = NDArray[np.float64]

SINGLE_PRECISION_PHASE = 200.0
"""Largest phase in radians, 2 pi n d / lambda of a layer times its repeats, left to single precision.

A phase of 200 is rounded to 1e-5 of a radian in 24 bits; the goldens with larger ones show errors above 1e-5.
"""

SINGLE_TOLERANCE = 2e-5
"""Measured rounding of R and T above which a film is solved in double precision."""

CLEAR_K = 1e-3
"""Below this k a layer damps a resonance too little for single precision."""

LEAST, MOST = -1e-6, 1 + 2e-5
"""Bounds of R and T before clamping; what lies outside is a fault and not rounding."""


@dataclass(frozen=True, eq=False)
class Grid:
    """The points a film is evaluated at: every combination of the three axes.

    Parameters
    ----------
    thickness_scale, cos_theta, wavelength_nm : float arrays, shape (S,), (A,) and (L,)
    """

    thickness_scale: FloatArray
    cos_theta: FloatArray
    wavelength_nm: FloatArray


def film_problem(stack: Stack, spread: ThicknessSpread, grid: Grid) -> FilmProblem:
    """Sample the stack at the grid's wavelengths and lay its thicknesses out, (S, V, M).

    Raises
    ------
    SpecError
        A material cannot be used at a wavelength.
    BudgetError
        The thicknesses alone exceed the byte budget.
    """
    return problem_of(sample_stack(stack, grid.wavelength_nm), spread, grid)


def problem_of(sampled: SampledStack, spread: ThicknessSpread, grid: Grid) -> FilmProblem:
    """Return the same of a stack that has been sampled at the grid's wavelengths."""
    thicknesses = grid.thickness_scale.size * spread.offset_nm.size
    require(f"a film of {thicknesses:,} thicknesses", thicknesses * np.dtype(np.float64).itemsize)
    variants = sampled.thickness_nm + spread.offset_nm  # (V, M)
    return FilmProblem(
        wavelength_nm=sampled.wavelength_nm,
        index=sampled.index,
        segments=segments(sampled),
        thickness_nm=grid.thickness_scale[:, None, None] * variants,
        weights=spread.weights,
        cos_theta=grid.cos_theta,
    )


def segments(stack: SampledStack) -> tuple[Segment, ...]:
    """Cut a stack into runs, periodic groups and thick layers, from the substrate outwards."""
    cuts = {span.first: Segment(span.first, span.stop, span.repeat) for span in stack.groups}
    cuts |= {int(j): Segment(int(j), int(j) + 1, THICK) for j in np.flatnonzero(~stack.coherent)}
    ordered, position = [], 0
    for first in sorted(cuts):
        if first > position:
            ordered.append(Segment(position, first, 1))
        ordered.append(cuts[first])
        position = cuts[first].stop
    if position < len(stack.thickness_nm):
        ordered.append(Segment(position, len(stack.thickness_nm), 1))
    return tuple(reversed(ordered))


def optical_thickness_nm(problem: FilmProblem) -> FloatArray:
    """Sum n d over each segment and its repeats, at the largest scale: (segments, L), 0 for a thick layer."""
    thickest = problem.thickness_nm.max(axis=(0, 1))  # (M,)
    depth = problem.index[1:-1].real * thickest[:, None]  # (M, L)
    return np.array([s.repeat * depth[s.first : s.stop].sum(axis=0) for s in problem.segments])


def phase_precision(problem: FilmProblem, asked: Precision) -> Precision:
    """Return `asked`, or double precision where single cannot hold a phase or a resonance of the film.

    Echoes in a thick layer are resonances, too: near total reflection they are a small number's reciprocal.
    """
    lost = problem.incoherent or _largest_phase(problem) > SINGLE_PRECISION_PHASE or _traps_light(problem)
    return Precision.DOUBLE if lost else asked


def _largest_phase(problem: FilmProblem) -> float:
    """Largest 2 pi |n| d / lambda of a layer times its repeats, in radians; 0 for a thick layer."""
    thickest = problem.thickness_nm.max(axis=(0, 1))  # (M,)
    repeats = np.zeros(thickest.size)
    for segment in problem.segments:
        repeats[segment.first : segment.stop] = segment.repeat
    size = np.abs(problem.index[1:-1])  # (M, L)
    phase = 2 * np.pi * (size / problem.wavelength_nm) * (thickest * repeats)[:, None]
    return float(phase.max())


def _traps_light(problem: FilmProblem) -> bool:
    """Whether light from the incident medium meets a clear medium that is less dense.

    Between two such layers it can be totally reflected to and fro, in resonances as narrow as one likes:
    single precision moves them by more than their width, and R and T are off by up to 0.03 (measured).
    """
    clear = problem.index[1:].imag < CLEAR_K
    return bool((clear & (problem.index[1:].real < problem.index[0].real)).any())


def checked_intensities(
    device: Device, problem: FilmProblem, precision: Precision, observer: Observer | None = None
) -> dict[str, NDArray[np.floating]]:
    """R_s, R_p, T_s and T_p of shape (S, A, L), within [0, 1].

    Raises
    ------
    NumericalError
        A value is not finite, or lies outside [0, 1] by more than rounding explains.
    """
    computed = film_intensities(device, problem, precision, observer=observer)
    for name, values in computed.items():
        least, most = check_range(name, values)
        if least < 0 or most > 1:
            np.clip(values, 0, 1, out=values)
    return computed


def check_range(name: str, values: NDArray[np.floating]) -> tuple[float, float]:
    """Return the least and the largest of the values, which are ratios.

    Raises
    ------
    NumericalError
        A value is not finite, which a clamp would hide, or is no ratio.
    """
    least, most = float(values.min()), float(values.max())
    if not (least >= LEAST and most <= MOST):  # False for NaN, too
        bad = int(np.count_nonzero(~np.isfinite(values)))
        message = f"{name} lies in [{least:.9g}, {most:.9g}] with {bad} values that are not finite"
        raise NumericalError(f"{message}; it must lie in [0, 1]. Please report this stack.")
    return least, most
