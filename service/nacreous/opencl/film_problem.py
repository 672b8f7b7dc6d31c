"""A film as the kernels take it: plain arrays in double precision, and the buffers made of them."""

import functools
import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.device import Device
from nacreous.opencl.precision import Precision

__all__ = [
    "THICK",
    "FilmBuffers",
    "FilmProblem",
    "Segment",
    "film_buffers",
    "upload",
    "upload_colour_weights",
]

THICK = 0
"""`Segment.repeat` of one thick layer, across which intensities are added."""

_CRITICAL_MARGIN = 1e-6
"""How far above the critical angle, in mu^2, a wave counts as transparent: more than its rounding."""


@dataclass(frozen=True)
class Segment:
    """Layers `first` to `stop` - 1, crossed `repeat` times; `THICK` for one incoherent layer."""

    first: int
    stop: int
    repeat: int


@dataclass(frozen=True, eq=False)
class FilmProblem:
    """Everything that decides R and T.

    Parameters
    ----------
    wavelength_nm : float array, shape (L,)
    index : complex array, shape (M + 2, L)
        n + ik of the incident medium (k = 0), each layer once, and the substrate.
    segments : tuple of Segment
        The stack from the substrate outwards; together they hold each layer once.
    thickness_nm : float array, shape (S, V, M)
        For each thickness scale, V variants that are averaged.
    weights : float array, shape (V,)
        Of sum 1.
    cos_theta : float array, shape (A,)
    """

    wavelength_nm: NDArray[np.float64]
    index: NDArray[np.complex128]
    segments: tuple[Segment, ...]
    thickness_nm: NDArray[np.float64]
    weights: NDArray[np.float64]
    cos_theta: NDArray[np.float64]

    @property
    def shape(self) -> tuple[int, int, int]:
        """Thickness scales, angles and wavelengths: (S, A, L)."""
        return len(self.thickness_nm), len(self.cos_theta), len(self.wavelength_nm)

    @property
    def rows(self) -> int:
        """Thickness scales times angles: what a launch is tiled over."""
        return self.shape[0] * self.shape[1]

    @property
    def incoherent(self) -> bool:
        """Whether any layer is crossed in intensities."""
        return any(segment.repeat == THICK for segment in self.segments)

    @property
    def build_numbers(self) -> tuple[tuple[str, int], ...]:
        """What the kernels are compiled for: the kinds of segments that there are, and room for media.

        The room is a power of four, so that few programs serve all films.
        """
        periodic = any(segment.repeat > 1 for segment in self.segments)
        room = next(room for n in itertools.count(1) if (room := 4**n) >= max(self.medium_of) + 1)
        return ("INCOHERENT", int(self.incoherent)), ("PERIODIC", int(periodic)), ("MEDIA", room)

    @functools.cached_property
    def medium_of(self) -> tuple[int, ...]:
        """Number of the medium of each layer and the substrate: equal rows of `index` are one medium."""
        numbers: dict[bytes, int] = {}
        return tuple(numbers.setdefault(row.tobytes(), len(numbers)) for row in self.index[1:])

    @property
    def layer_evaluations_a_row(self) -> int:
        """Layers crossed for one row, with every variant: what a launch's time goes by."""
        variants, layers = self.thickness_nm.shape[1:]
        return int(variants * (layers + 1) * len(self.wavelength_nm))


@dataclass(frozen=True, eq=False)
class FilmBuffers:
    """The kernels' common arguments, up to the row origin; keeps the buffers alive while a launch runs."""

    arguments: tuple[Any, ...]
    stride: int


def film_buffers(device: Device, problem: FilmProblem, precision: Precision, lanes: int) -> FilmBuffers:
    """Upload a problem, its wavelengths padded to whole lanes; see kernels/film.cl for the arguments."""
    dtype = precision.dtype
    padded = _padded(problem, lanes)
    stride = padded.wavelength_nm.size
    n0 = padded.index[0].real
    incident = np.stack([n0, 1 / n0, 1 / padded.wavelength_nm])  # (3, stride)
    segments = np.array([(s.first, s.stop, s.repeat) for s in problem.segments], np.int32)
    variants, layers = problem.thickness_nm.shape[1:]
    media = [problem.medium_of.index(number) for number in range(max(problem.medium_of) + 1)]
    index = padded.index[[0, *(1 + layer for layer in media)]]  # (media + 1, stride)
    counts = (len(media), len(segments), layers, stride)
    grid = (variants, problem.shape[1])
    arguments = (
        upload(device, _media(index), dtype),
        upload(device, _critical_mu2(index, lanes), dtype),
        upload(device, np.array(problem.medium_of), np.int32),
        upload(device, segments, np.int32),
        *map(np.int32, counts),
        upload(device, incident, dtype),
        upload(device, problem.cos_theta, dtype),
        upload(device, problem.thickness_nm, dtype),
        upload(device, problem.weights, dtype),
        *map(np.int32, grid),
    )
    return FilmBuffers(arguments, stride)


def _padded(problem: FilmProblem, lanes: int) -> FilmProblem:
    """Repeat the last wavelength up to a multiple of `lanes`."""
    missing = -problem.wavelength_nm.size % lanes
    wavelength_nm = np.pad(problem.wavelength_nm, (0, missing), mode="edge")
    index = np.pad(problem.index, ((0, 0), (0, missing)), mode="edge")
    return FilmProblem(
        wavelength_nm, index, problem.segments, problem.thickness_nm, problem.weights, problem.cos_theta
    )


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


def upload(device: Device, array: NDArray[Any], dtype: Any) -> Any:  # noqa: ANN401 - pyopencl is untyped
    """Copy an array into a new read-only buffer of the device."""
    import pyopencl as cl

    flags = cl.mem_flags.READ_ONLY | cl.mem_flags.COPY_HOST_PTR
    return cl.Buffer(device.context, flags, hostbuf=np.ascontiguousarray(array, dtype))


def upload_colour_weights(device: Device, weights: NDArray[np.float64], stride: int, dtype: Any) -> Any:  # noqa: ANN401 - pyopencl is untyped
    """Copy weights (3, L) into a buffer of (3, stride), in which what pads the wavelengths weighs nothing."""
    return upload(device, np.pad(weights, ((0, 0), (0, stride - weights.shape[1]))), dtype)
