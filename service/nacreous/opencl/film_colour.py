"""Linear colour of a film over thickness scale and angle: the host of kernels/film_colour.cl."""

from enum import Enum

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.film_problem import FilmProblem, film_buffers, upload_colour_weights
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.opencl.tiles import Observer, TileRunner, empty_table, row_tiles

__all__ = ["Side", "film_colour"]

_GROUPS = {"cpu": (4,), "gpu": (64,), "other": (1,)}


class Side(Enum):
    """Whose colour: the reflected or the transmitted light's. The value is the kernel's TRANSMISSION."""

    REFLECTION = 0
    TRANSMISSION = 1


def film_colour(
    device: Device,
    problem: FilmProblem,
    colour_weights: NDArray[np.float64],
    side: Side,
    precision: Precision,
    *,
    observer: Observer | None = None,
    lanes: int | None = None,
) -> NDArray[np.floating]:
    """Sum of the unpolarised R or T times three weights a wavelength, shape (S, A, 3).

    Parameters
    ----------
    colour_weights : float array, shape (3, L)
        Weights of the three components at the problem's wavelengths, see `nacreous.optics.colour`.

    Raises
    ------
    BudgetError
        The result is larger than the byte budget; nothing is allocated.
    """
    item = np.dtype(precision.dtype).itemsize
    require(f"a colour table of {' x '.join(map(str, problem.shape[:2]))} texels", problem.rows * 3 * item)
    lanes = lanes or device.lanes(precision)
    numbers = (*problem.build_numbers, ("TRANSMISSION", side.value))
    kernel = kernel_of(device, Build("film_colour", precision, lanes, numbers))
    buffers = film_buffers(device, problem, precision, lanes)
    weights = upload_colour_weights(device, colour_weights, buffers.stride, precision.dtype)
    colour = empty_table(problem.rows, 3, precision.dtype)
    runner = TileRunner(device, kernel, (colour,), 3, _GROUPS[device.info.kind])
    for tile in row_tiles(problem.rows, problem.layer_evaluations_a_row, 3 * item, observer):
        runner.run(tile, (*buffers.arguments, *tile.bounds, weights), (tile.rows,))
    return colour.reshape(*problem.shape[:2], 3)
