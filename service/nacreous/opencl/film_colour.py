"""Linear colours of a film over thickness scale and angle: the host of kernels/film_colour.cl."""

from enum import Enum

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.film_buffers import film_buffers, upload_colour_weights
from nacreous.opencl.film_problem import FilmProblem
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.opencl.tiles import Observer, TileRunner, empty_table, row_tiles

__all__ = ["Side", "film_colours"]

_GROUPS = {"cpu": (4,), "gpu": (64,), "other": (1,)}


class Side(Enum):
    """Whose light: what is reflected or what is transmitted. Kernels know them by these numbers."""

    REFLECTION = 0
    TRANSMISSION = 1


def film_colours(
    device: Device,
    problem: FilmProblem,
    colour_weights: NDArray[np.float64],
    sides: tuple[Side, ...],
    precision: Precision,
    *,
    observer: Observer | None = None,
    lanes: int | None = None,
) -> NDArray[np.floating]:
    """Sum of the unpolarised R, or T, times three weights a wavelength, shape (sides, S, A, 3).

    Parameters
    ----------
    colour_weights : float array, shape (3, L)
        Weights of the three components at the problem's wavelengths, see `nacreous.optics.colour`.
    sides : tuple of Side
        R costs nothing beside T.

    Raises
    ------
    BudgetError
        The result is larger than the byte budget; nothing is allocated.
    """
    computed = max(side.value for side in sides) + 1
    columns, item = 3 * computed, np.dtype(precision.dtype).itemsize
    texels = f"a colour table of {' x '.join(map(str, problem.shape[:2]))} texels"
    require(texels, problem.rows * columns * item)
    lanes = lanes or device.lanes(precision)
    buffers = film_buffers(device, problem, precision, lanes)
    numbers = (*buffers.build_numbers, ("SIDES", computed))
    kernel = kernel_of(device, Build("film_colour", precision, lanes, numbers))
    weights = upload_colour_weights(device, colour_weights, buffers.stride, precision.dtype)
    colours = empty_table(problem.rows, columns, precision.dtype)
    runner = TileRunner(device, kernel, (colours,), columns, _GROUPS[device.info.kind])
    for tile in row_tiles(problem.rows, problem.layer_evaluations_a_row, columns * item, observer):
        runner.run(tile, (*buffers.arguments, *tile.bounds, weights), (tile.rows,))
    by_side = np.moveaxis(colours.reshape(*problem.shape[:2], computed, 3), 2, 0)
    return np.ascontiguousarray(by_side[[side.value for side in sides]])
