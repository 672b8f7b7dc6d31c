"""A film on the device: the arguments that all film kernels take first."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.device import Device
from nacreous.opencl.film_problem import FilmProblem
from nacreous.opencl.layer_polynomials import layer_degree, layer_polynomials
from nacreous.opencl.polynomials import Form, Polynomials
from nacreous.opencl.precision import Precision
from nacreous.opencl.stack_polynomials import stack_degree, stack_polynomials
from nacreous.opencl.upload import upload

__all__ = ["FilmBuffers", "film_buffers", "upload_colour_weights"]

_CRITICAL_MARGIN = 1e-6
"""How far above the critical angle, in mu^2, a wave counts as transparent: more than its rounding."""

_LARGEST_GROWTH = 16.0
"""log10 of the growth of a field that is left to the range of single precision; its square goes to 1e38."""
_LAYERS_IN_RANGE = 8
"""Layers that grow a field by no more than that where |n| is within 0.1 to 100."""


@dataclass(frozen=True, eq=False)
class FilmBuffers:
    """What film kernels are built with, and their common arguments up to the row origin.

    Keeps the buffers alive while a launch runs.
    """

    arguments: tuple[Any, ...]
    stride: int
    build_numbers: tuple[tuple[str, int], ...]


def film_buffers(device: Device, problem: FilmProblem, precision: Precision, lanes: int) -> FilmBuffers:
    """Upload a problem, its wavelengths padded to whole lanes; see kernels/stack.clh for the arguments."""
    dtype = precision.dtype
    padded = _padded(problem, lanes)
    stride = padded.wavelength_nm.size
    n0 = padded.index[0].real
    numbers = [problem.medium_of.index(number) for number in range(max(problem.medium_of) + 1)]
    index = padded.index[[0, *(1 + layer for layer in numbers)]]  # (media + 1, stride)
    media = upload(device, _media(index), dtype)
    medium_of = upload(device, np.array(problem.medium_of), np.int32)
    thickness_nm = upload(device, problem.thickness_nm, dtype)
    incident = upload(device, np.stack([n0, 1 / n0, 1 / padded.wavelength_nm]), dtype)  # (3, stride)
    critical_mu2 = upload(device, _critical_mu2(index, lanes), dtype)
    segments = np.array([(s.first, s.stop, s.repeat) for s in problem.segments], np.int32)
    variants, layers = problem.thickness_nm.shape[1:]
    counts = (len(numbers), len(segments), layers, stride, _rescale_after(problem))
    film = (
        media,
        critical_mu2,
        medium_of,
        upload(device, segments, np.int32),
        *map(np.int32, counts),
        thickness_nm,
    )
    polynomials = _polynomials(device, film, incident, problem, precision, lanes)
    cosines = upload(device, problem.cos_theta, dtype)
    arguments = (
        *film,
        polynomials.coefficients or thickness_nm,  # a kernel without polynomials has no use for its argument
        incident,
        cosines,
        polynomials.chebyshev or cosines,
        upload(device, problem.weights, dtype),
        *map(np.int32, (variants, problem.shape[1])),
    )
    return FilmBuffers(arguments, stride, (*problem.build_numbers, *polynomials.build_numbers))


def _polynomials(
    device: Device,
    film: tuple[Any, ...],
    incident: Any,  # noqa: ANN401 - pyopencl is untyped
    problem: FilmProblem,
    precision: Precision,
    lanes: int,
) -> Polynomials:
    """Return those of the stack, else those of its layers, else none, whichever is exact and pays."""
    thickness_nm = film[-1]
    if degree := stack_degree(problem, precision):
        arguments = (*film, thickness_nm, incident)
        if found := stack_polynomials(device, arguments, problem, degree, precision, lanes):
            return found
    if degree := layer_degree(problem, precision):
        layers = (*film[:3], incident, thickness_nm)
        return layer_polynomials(device, layers, problem, degree, precision, lanes)
    return Polynomials(Form.WAVES, 0, None)


def _rescale_after(problem: FilmProblem) -> int:
    """Return after how many layers the kernels bring a field back into range.

    A layer multiplies a field by at most 1 + a max(1, |n^2|, |kz^2|, |kz^2 / n^2|) with a = 2 pi d / lambda,
    its decay apart: |cos z| <= 1 and |sin z / z| <= 1.
    """
    size = np.abs(problem.index)  # (M + 2, L)
    n2, least_n2, n02 = size[1:-1].max(axis=1) ** 2, size[1:-1].min(axis=1) ** 2, size[0].max() ** 2
    kz2 = n2 + n02
    largest = np.maximum.reduce([np.ones(n2.size), kz2, kz2 / least_n2])
    a = 2 * np.pi * problem.thickness_nm.max(axis=(0, 1)) / problem.wavelength_nm.min()
    growth = np.log10(1 + a * largest).sum()
    return _LAYERS_IN_RANGE if growth > _LARGEST_GROWTH else largest.size + 1


def _padded(problem: FilmProblem, lanes: int) -> FilmProblem:
    """Repeat the last wavelength up to a multiple of `lanes`."""
    missing = -problem.wavelength_nm.size % lanes
    if missing == 0:
        return problem
    last = problem.wavelength_nm.size - 1
    at = np.minimum(np.arange(last + 1 + missing), last)
    return replace(problem, wavelength_nm=problem.wavelength_nm[at], index=problem.index[:, at])


def _media(index: NDArray[np.complex128]) -> NDArray[np.float64]:
    """Rows of kernels/medium.clh for each medium after the incident one, shape (media, 5, stride)."""
    n, n0 = index[1:], index[0].real
    n_squared = n**2
    contrast = (n.real - n0) * (n.real + n0) - n.imag**2
    inverse = 1 / n_squared
    return np.stack([contrast, n_squared.imag, n_squared.real, inverse.real, inverse.imag], axis=1)


def _critical_mu2(index: NDArray[np.complex128], lanes: int) -> NDArray[np.float64]:
    """Square of the cosine above which a whole block of lanes is transparent, shape (media, stride / lanes).

    2, which no cosine reaches, where a lane absorbs.
    """
    n, n0 = index[1:], index[0].real
    critical = _CRITICAL_MARGIN - (n.real - n0) * (n.real + n0) / n0**2
    critical = np.where(n.imag > 0, 2.0, critical)
    of_blocks: NDArray[np.float64] = critical.reshape(len(n), -1, lanes).max(axis=-1)
    return of_blocks


def upload_colour_weights(device: Device, weights: NDArray[np.float64], stride: int, dtype: Any) -> Any:  # noqa: ANN401 - pyopencl is untyped
    """Copy weights (3, L) into a buffer of (3, stride), in which what pads the wavelengths weighs nothing."""
    padded = np.zeros((len(weights), stride), dtype)
    padded[:, : weights.shape[1]] = weights
    return upload(device, padded, dtype)
