"""f_r and f_t of a rough surface with a film: the host of kernels/bsdf.cl and bsdf_colour.cl."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.film_buffers import upload_colour_weights
from nacreous.opencl.film_colour import Side
from nacreous.opencl.microsurface import Microsurface, surface_arguments
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.opencl.tiles import Observer, Tile, TileRunner, empty_table, row_tiles
from nacreous.opencl.upload import upload

__all__ = ["BsdfProblem", "Pairs", "bsdf_colours", "bsdf_spectra"]

_FEWEST_NODES = 4
_FACET_EVALUATIONS = 50
"""What the geometry of a pair costs, in evaluations of a layer."""


@dataclass(frozen=True, eq=False)
class Pairs:
    """Pairs of directions, each at one of a surface's roughnesses.

    Parameters
    ----------
    roughness : int array, shape (P,)
        Place on the axis of roughnesses.
    incoming, outgoing : float arrays, shape (P, 3)
        Unit vectors away from the surface: `incoming` above it, `outgoing` above it for f_r, below for f_t.
    """

    roughness: NDArray[np.int32]
    incoming: NDArray[np.float64]
    outgoing: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class BsdfProblem:
    """Everything that decides the specular part of f_r or f_t.

    Parameters
    ----------
    surface : Microsurface
    side : Side
        f_r for reflection, f_t for transmission.
    film : float array, shape (K, L)
        Unpolarised R or T at K >= 4 cosines equally spaced over [0, 1].
    eta : float array, shape (2, L)
        Index of the incident medium and of the substrate.
    pairs : Pairs
    """

    surface: Microsurface
    side: Side
    film: NDArray[np.float64]
    eta: NDArray[np.float64]
    pairs: Pairs

    def __post_init__(self) -> None:
        if len(self.film) < _FEWEST_NODES:  # kernels/nodes.clh reads four
            raise ValueError(f"expected a film at {_FEWEST_NODES} cosines or more, got {len(self.film)}")


def bsdf_spectra(
    device: Device,
    problem: BsdfProblem,
    precision: Precision,
    *,
    observer: Observer | None = None,
    lanes: int | None = None,
) -> NDArray[np.floating]:
    """Specular part of f_r or f_t in 1 / sr, shape (P, L).

    Raises `BudgetError` before anything is allocated.
    """
    rows, wavelengths = len(problem.pairs.roughness), problem.film.shape[1]
    require(f"a BSDF of {rows:,} x {wavelengths:,} numbers", rows * wavelengths * _item(precision))
    f = empty_table(rows, wavelengths, precision.dtype)
    _run(device, "bsdf", problem, precision, lanes, observer, f, None)
    return f


def bsdf_colours(
    device: Device,
    problem: BsdfProblem,
    colour_weights: NDArray[np.float64],
    precision: Precision,
    *,
    observer: Observer | None = None,
    lanes: int | None = None,
) -> NDArray[np.floating]:
    """Sum of the specular f_r or f_t times three weights a wavelength, (3, L), in 1 / sr, shape (P, 3).

    Raises `BudgetError` before anything is allocated.
    """
    rows = len(problem.pairs.roughness)
    require(f"the colours of a BSDF of {rows:,} pairs of directions", rows * 3 * _item(precision))
    colour = empty_table(rows, 3, precision.dtype)
    _run(device, "bsdf_colour", problem, precision, lanes, observer, colour, colour_weights)
    return colour


def _item(precision: Precision) -> int:
    return int(np.dtype(precision.dtype).itemsize)


def _run(
    device: Device,
    kernel_name: str,
    problem: BsdfProblem,
    precision: Precision,
    lanes: int | None,
    observer: Observer | None,
    result: NDArray[np.floating],
    colour_weights: NDArray[np.float64] | None,
) -> None:
    """Fill `result`, (P, columns), in tiles of pairs."""
    lanes = lanes or device.lanes(precision)
    numbers = (*problem.surface.build_numbers, ("TRANSMISSION", problem.side.value))
    kernel = kernel_of(device, Build(kernel_name, precision, lanes, numbers))
    wavelengths = problem.film.shape[1]
    stride = wavelengths + -wavelengths % lanes
    columns = stride if colour_weights is None else 3
    surface = surface_arguments(device, problem.surface, precision)
    shared = (
        upload(device, _padded(problem.film, stride), precision.dtype),
        upload(device, _padded(problem.eta, stride), precision.dtype),
        np.int32(len(problem.film)),
        np.int32(stride),
    )
    weights = (
        ()
        if colour_weights is None
        else (upload_colour_weights(device, colour_weights, stride, precision.dtype),)
    )
    runner = TileRunner(device, kernel, (result,), columns, (1,))
    for tile in row_tiles(len(result), stride + _FACET_EVALUATIONS, columns * _item(precision), observer):
        pairs = _uploaded(device, problem.pairs, tile, precision)
        bounds = (np.int32(0), np.int32(tile.rows))
        runner.run(tile, (*surface, *pairs, *shared, *bounds, *weights), (tile.rows,))


def _uploaded(device: Device, pairs: Pairs, tile: Tile, precision: Precision) -> Iterator[Any]:
    """Upload the pairs of a tile, so that the device never holds all of them."""
    rows = slice(tile.origin, tile.origin + tile.rows)
    yield upload(device, pairs.roughness[rows], np.int32)
    yield upload(device, pairs.incoming[rows], precision.dtype)
    yield upload(device, pairs.outgoing[rows], precision.dtype)


def _padded(values: NDArray[np.float64], stride: int) -> NDArray[np.float64]:
    return np.pad(values, ((0, 0), (0, stride - values.shape[1])), mode="edge")
