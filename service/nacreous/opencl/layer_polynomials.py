"""Thin layers as polynomials of the angle: the host of kernels/layer_polynomials.cl, and where they pay.

C and S / kz of a layer are entire functions of kz^2, which is linear in mu^2. As functions of
z^2 = (2 pi d / lambda)^2 kz^2 they run through an interval of half width h = (2 pi d n0 / lambda)^2 / 2.
Interpolated at D + 1 Chebyshev nodes, cos(sqrt(z^2)) is off by at most h^(D+1) / ((2 D + 2)! 2^D), for its
m-th derivative is at most m! / (2 m)!; where waves decay it is larger by that decay, which is divided out.
"""

import math
from functools import cache
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

__all__ = ["DEGREES", "layer_degree", "layer_polynomials", "to_powers"]

DEGREES = (4, 6, 8)
"""Degrees that kernels are built for: few programs serve all films. Above the last, waves cost no more."""

_FEWEST_ANGLES = 48
"""Fewer do not pay for the coefficients."""

_MOST_DECAY = 1.0
"""Difference of a layer's decay between grazing and normal incidence: what it divides out costs digits."""


def layer_degree(problem: FilmProblem, precision: Precision) -> int:
    """Return the degree by which all layers are as exact as single precision; 0 where waves are better."""
    if precision is Precision.DOUBLE or problem.incoherent or problem.cos_theta.size < _FEWEST_ANGLES:
        return 0
    if not is_worth_a_program(problem) or _decay_range(problem) > _MOST_DECAY:
        return 0
    degree = next((degree for degree in DEGREES if _truncation(problem, degree) < TOLERANCE), 0)
    numbers = problem.thickness_nm.size * problem.wavelength_nm.size * _runs(degree)
    return degree if numbers <= MOST_NUMBERS else 0


def layer_polynomials(
    device: Device, film: tuple[Any, ...], problem: FilmProblem, degree: int, precision: Precision, lanes: int
) -> Polynomials:
    """Return the coefficients of a problem's layers, as they are being computed.

    Parameters
    ----------
    film : tuple of buffers
        Media, where they are clear, the medium of each layer, the incident medium and thicknesses, as film
        kernels take them.
    """
    import pyopencl as cl

    thicknesses, layers = problem.thickness_nm.size, problem.thickness_nm.shape[-1]
    blocks = -(-problem.wavelength_nm.size // lanes)
    filled = empty_buffer(device, (thicknesses, blocks * lanes, _runs(degree)), precision.dtype)
    nodes = upload(device, _interpolation(degree), precision.dtype)
    counts = map(np.int32, (layers, blocks * lanes, thicknesses))
    kernel = kernel_of(device, Build("layer_polynomials", precision, lanes, (("DEGREE", degree),)))
    kernel.set_args(*film, *counts, nodes, filled)
    cl.enqueue_nd_range_kernel(device.queue, kernel, (blocks, thicknesses), (1, 1))
    return Polynomials(Form.OF_LAYERS, degree, filled)


@cache
def _interpolation(degree: int) -> NDArray[np.float64]:
    """All that a kernel interpolates by, in one piece."""
    tables = node_mu2(degree), to_chebyshev(degree).ravel(), to_powers(degree).ravel()
    return np.concatenate(tables)


def _runs(degree: int) -> int:
    """Numbers that a layer has for a wavelength: see kernels/polynomial_layer.clh."""
    return 4 * (degree + 1) + 1


def _truncation(problem: FilmProblem, degree: int) -> float:
    n0_over_lambda = float((problem.index[0].real / problem.wavelength_nm).max())
    half_width = (2 * math.pi * float(problem.thickness_nm.max()) * n0_over_lambda) ** 2 / 2
    terms = degree + 1
    return half_width**terms / (math.factorial(2 * terms) * 2.0**degree)


def _decay_range(problem: FilmProblem) -> float:
    """Largest 2 pi d (Im kz at mu = 0 - Im kz at mu = 1) / lambda of layers less dense than the outside."""
    index, n0 = problem.index[1:-1], problem.index[0].real
    rare = (index.real < n0).any(axis=1)
    change = np.sqrt(index[rare] ** 2 - n0**2).imag - index[rare].imag  # (layers, L)
    turns = problem.thickness_nm.max(axis=(0, 1))[rare, None] / problem.wavelength_nm
    return float(2 * math.pi * (turns * change).max(initial=0))


def to_powers(degree: int) -> NDArray[np.float64]:
    """Return what takes coefficients of Chebyshev polynomials to those of powers of t, (power, order)."""
    matrix = np.zeros((degree + 1, degree + 1))
    for order, unit in enumerate(np.eye(degree + 1)):
        powers = chebyshev.cheb2poly(unit)
        matrix[: powers.size, order] = powers
    return matrix
