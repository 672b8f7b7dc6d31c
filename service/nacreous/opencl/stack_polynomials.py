"""Whole stacks as polynomials of the angle: the host of kernels/stack_polynomials.cl, and where they pay.

A function that is analytic within the ellipse about [0, 1] whose half axes sum to rho / 2, and at most M
there, is off by at most 4 M rho^-D / (rho - 1) where it is interpolated at D + 1 Chebyshev nodes (Trefethen
2013, Approximation Theory and Approximation Practice, theorem 8.2). The entries of a stack's matrix are
analytic everywhere. They grow as the exponential of the decay that a complex mu^2 would mean: the sum over
the layers of 2 pi d |Im kz| / lambda.
"""

from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from nacreous.opencl.device import Device
from nacreous.opencl.film_problem import FilmProblem
from nacreous.opencl.polynomials import (
    MOST_NUMBERS,
    TOLERANCE,
    Form,
    Polynomials,
    is_worth_a_program,
    node_mu2,
    to_chebyshev,
)
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.opencl.upload import empty_buffer, upload

__all__ = ["DEGREES", "stack_degree", "stack_polynomials"]

DEGREES = (8, 10, 12, 16, 20)
"""Degrees that kernels are built for: few programs serve all films."""

_LARGEST_ERROR = 32.0
"""Of R and T, in the error of one layer: what the layers add up to, as in a random walk, times by how much
the fields of other angles are larger."""

_RHO = np.array([3.0, 4, 6, 8, 12, 16, 24, 32])
_CIRCLES = _RHO[:, None] * np.exp(1j * np.linspace(np.pi / 2, np.pi, 7))
_ELLIPSES = (2 + _CIRCLES + 1 / _CIRCLES) / 4
"""mu^2 on ellipses about [0, 1], (ellipse, point), on the side of small real parts: most decay is there."""

_PARTS = 8
_CROSSING, _PREPARING = 35, 120
"""Operations to cross a layer by its own polynomials, and by waves for both columns of a matrix."""


def stack_degree(problem: FilmProblem, precision: Precision) -> int:
    """Return the degree by which the stack is as exact as single precision; 0 where layers are better."""
    if precision is Precision.DOUBLE or problem.incoherent or problem.periodic:
        return 0
    if not is_worth_a_program(problem):
        return 0
    growth = _growth(problem)
    degree = next((degree for degree in DEGREES if _truncation(growth, degree) < TOLERANCE), 0)
    numbers = np.prod(problem.thickness_nm.shape[:2]) * problem.wavelength_nm.size * _runs(degree)
    return degree if numbers <= MOST_NUMBERS and _pays(problem, degree) else 0


def _growth(problem: FilmProblem) -> NDArray[np.float64]:
    """Return the largest decay on each ellipse, less that on [0, 1], which is divided out; (ellipses,).

    Looked at where the spectrum begins, in its middle and at its end.
    """
    some = [0, problem.wavelength_nm.size // 2, -1]
    n0_squared = problem.index[0, some].real ** 2  # (3,)
    contrast = problem.index[1:-1, some] ** 2 - n0_squared  # (M, 3)
    kz = np.sqrt(contrast[..., None, None] + n0_squared[:, None, None] * _ELLIPSES)  # (M, 3, ellipse, point)
    decay = np.abs(kz.imag) - np.sqrt(contrast).imag[..., None, None]
    a = 2 * np.pi * problem.thickness_nm.max(axis=(0, 1))[:, None] / problem.wavelength_nm[some]  # (M, 3)
    growth: NDArray[np.float64] = np.einsum("ml,mlrp->lrp", a, decay).max(axis=(0, 2))
    return growth


def _truncation(growth: NDArray[np.float64], degree: int) -> float:
    return float((4 * np.exp(growth) * _RHO**-degree / (_RHO - 1)).min())


def _pays(problem: FilmProblem, degree: int) -> bool:
    """Tell whether what angles save is more than what the coefficients cost, in operations."""
    layers, terms = problem.thickness_nm.shape[-1], degree + 1
    saved = layers * _CROSSING - 2 * _PARTS * (terms + 1)
    return bool(saved * problem.cos_theta.size > terms * (layers * _PREPARING + 2 * _PARTS * terms))


def _runs(degree: int) -> int:
    """Numbers that a stack has for a wavelength: see kernels/polynomial_stack.clh."""
    return 2 * (degree + 1) * _PARTS + 2


def stack_polynomials(
    device: Device, film: tuple[Any, ...], problem: FilmProblem, degree: int, precision: Precision, lanes: int
) -> Polynomials | None:
    """Return the coefficients of a problem's stack, or None where they would lose too many digits.

    Parameters
    ----------
    film : tuple
        Arguments of a film kernel up to the incident medium, whatever its polynomials.
    """
    import pyopencl as cl

    dtype = precision.dtype
    thicknesses = int(np.prod(problem.thickness_nm.shape[:2]))
    stride = -(-problem.wavelength_nm.size // lanes) * lanes
    filled = empty_buffer(device, (thicknesses, stride, _runs(degree)), dtype)
    spread = np.empty((thicknesses, 2, stride), dtype)
    spread_buffer = empty_buffer(device, spread.shape, dtype)
    mu = _nodes_and_probes(degree)
    angles, of_angles = upload(device, mu, dtype), upload(device, _chebyshev(mu, degree), dtype)
    interpolation = upload(device, to_chebyshev(degree), dtype)
    numbers = (*problem.build_numbers, ("POLYNOMIALS", Form.WAVES), ("DEGREE", degree))
    kernel = kernel_of(device, Build("stack_polynomials", precision, lanes, numbers))
    rows = map(np.int32, (1, mu.size, 0, thicknesses))
    kernel.set_args(*film, angles, of_angles, angles, *rows, interpolation, filled, spread_buffer)
    cl.enqueue_nd_range_kernel(device.queue, kernel, (stride // lanes, thicknesses), (1, 1))
    cl.enqueue_copy(device.queue, spread, spread_buffer)
    if not problem.thickness_nm.shape[-1] * float(spread.max()) <= _LARGEST_ERROR**2:  # nor is a NaN
        return None
    of_film = upload(device, _chebyshev(problem.cos_theta, degree), dtype)
    return Polynomials(Form.OF_STACK, degree, filled, of_film)


def _nodes_and_probes(degree: int) -> NDArray[np.float64]:
    """Cosines of the nodes, and after them those of grazing incidence and of twice as many angles."""
    mu: NDArray[np.float64] = np.sqrt(np.concatenate([node_mu2(degree), [0.0], node_mu2(2 * degree + 1)]))
    return mu


def _chebyshev(cos_theta: NDArray[np.float64], degree: int) -> NDArray[np.float64]:
    """T_0 to T_D of 2 mu^2 - 1, (A, D + 1)."""
    return chebyshev.chebvander(2 * cos_theta**2 - 1, degree).astype(np.float64)
