"""Films given as plain numbers, evaluated by the kernels: the counterpart of reference.py for tests."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from nacreous.opencl.device import Device, open_device
from nacreous.opencl.film import film_intensities
from nacreous.opencl.film_problem import THICK, FilmProblem, Segment
from nacreous.opencl.precision import Precision
from reference import Groups, Intensities, film

DOUBLE_TOLERANCE = 1e-12
SINGLE_TOLERANCE = 2e-5


def tolerance(precision: Precision) -> float:
    """Error of R and T that model.md allows a stack of moderate phases."""
    return DOUBLE_TOLERANCE if precision is Precision.DOUBLE else SINGLE_TOLERANCE


def plain_problem(
    index: ArrayLike,
    thickness_nm: ArrayLike,
    wavelength_nm: ArrayLike,
    cos_theta: ArrayLike,
    *,
    groups: Groups = (),
    coherent: Sequence[bool] | None = None,
) -> FilmProblem:
    """Lay a film out for the kernels; the parameters are those of `reference.incoherent_film`."""
    wavelengths = np.array(wavelength_nm, float, ndmin=1)
    n = np.asarray(index, complex)
    n = np.broadcast_to(n[:, None] if n.ndim == 1 else n, (len(n), wavelengths.size))
    thickness = np.array(thickness_nm, float, ndmin=1)
    keep = [True] * thickness.size if coherent is None else list(coherent)
    return FilmProblem(
        wavelength_nm=wavelengths,
        index=n,
        segments=_segments(thickness.size, groups, keep),
        thickness_nm=thickness.reshape(1, 1, -1),
        weights=np.ones(1),
        cos_theta=np.array(cos_theta, float, ndmin=1),
    )


def _segments(layers: int, groups: Groups, coherent: Sequence[bool]) -> tuple[Segment, ...]:
    """Every layer a segment of its own, but for the groups; from the substrate outwards."""
    periodic = {first: Segment(first, stop, repeat) for first, stop, repeat in groups}
    ordered, position = [], 0
    while position < layers:
        alone = Segment(position, position + 1, 1 if coherent[position] else THICK)
        ordered.append(periodic.get(position, alone))
        position = ordered[-1].stop
    return tuple(reversed(ordered))


def one_run(problem: FilmProblem) -> FilmProblem:
    """Return the same coherent film with all its layers in one segment, as tables lay them out."""
    layers = problem.thickness_nm.shape[-1]
    return FilmProblem(
        problem.wavelength_nm,
        problem.index,
        (Segment(0, layers, 1),) if layers else (),
        problem.thickness_nm,
        problem.weights,
        problem.cos_theta,
    )


def kernel_film(
    index: ArrayLike,
    thickness_nm: ArrayLike,
    wavelength_nm: ArrayLike,
    cos_theta: ArrayLike,
    *,
    groups: Groups = (),
    coherent: Sequence[bool] | None = None,
    precision: Precision = Precision.DOUBLE,
    lanes: int | None = None,
) -> Intensities:
    """R and T of a film as kernels/film.cl gives them, (A, L) each, not clamped."""
    problem = plain_problem(index, thickness_nm, wavelength_nm, cos_theta, groups=groups, coherent=coherent)
    if not groups and coherent is None:
        problem = one_run(problem)
    computed = film_intensities(open_device(), problem, precision, lanes=lanes)
    return Intensities(*(np.asarray(computed[name][0], np.float64) for name in Intensities._fields))


def largest_error(device: Device, problem: FilmProblem, lanes: int | None = None) -> float:
    """Return by how much R and T in single precision differ from tests/reference.py."""
    got = film_intensities(device, problem, Precision.SINGLE, lanes=lanes)
    d_nm = problem.thickness_nm[0, 0]
    expected = film(problem.index, d_nm, problem.wavelength_nm, problem.cos_theta)
    return max(float(np.abs(got[name][0] - getattr(expected, name)).max()) for name in got)
