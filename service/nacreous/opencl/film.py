"""R and T of a film over thickness scale, angle and wavelength: the host of kernels/film.cl."""

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.film_buffers import film_buffers
from nacreous.opencl.film_problem import FilmProblem
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.opencl.tiles import Observer, TileRunner, empty_tables, row_tiles

__all__ = ["GROUPS", "NAMES", "film_intensities", "spectral_rows"]

NAMES = ("R_s", "R_p", "T_s", "T_p")

_MOST_PADDING = 1.25
"""Width of a row on the device, over that of the table, up to which it is kept as it is, padding and all."""

GROUPS = {"cpu": (1, 64), "gpu": (32, 4), "other": (1, 1)}
"""Work-group sizes (blocks of wavelengths, rows) by kind of device; PoCL compiles anew for each size."""


def film_intensities(
    device: Device,
    problem: FilmProblem,
    precision: Precision,
    *,
    observer: Observer | None = None,
    lanes: int | None = None,
) -> dict[str, NDArray[np.floating]]:
    """R_s, R_p, T_s and T_p, each of shape (S, A, L), as the kernel gives them: not clamped.

    Parameters
    ----------
    lanes : int, optional
        Lane width; without one, the device's own.

    Raises
    ------
    BudgetError
        The four arrays are larger than the byte budget; nothing is allocated.
    """
    return spectral_rows(device, "film", NAMES, problem, precision, observer, lanes)


def spectral_rows(
    device: Device,
    kernel_name: str,
    names: tuple[str, ...],
    problem: FilmProblem,
    precision: Precision,
    observer: Observer | None,
    lanes: int | None,
) -> dict[str, NDArray[np.floating]]:
    """Run a kernel that stores, for each row, `names` over the wavelengths; (S, A, L) each."""
    rows, wavelengths = problem.rows, problem.wavelength_nm.size
    item = np.dtype(precision.dtype).itemsize
    require(
        f"a table of {' x '.join(map(str, problem.shape))} x {len(names)} numbers",
        rows * wavelengths * len(names) * item,
    )
    lanes = lanes or device.lanes(precision)
    buffers = film_buffers(device, problem, precision, lanes)
    kernel = kernel_of(device, Build(kernel_name, precision, lanes, buffers.build_numbers))
    columns = buffers.stride if buffers.stride <= _MOST_PADDING * wavelengths else wavelengths
    results = empty_tables(len(names), rows, columns, precision.dtype)
    runner = TileRunner(device, kernel, results, buffers.stride, GROUPS[device.info.kind])
    bytes_a_row = buffers.stride * len(names) * item
    for tile in row_tiles(rows, problem.layer_evaluations_a_row, bytes_a_row, observer):
        runner.run(tile, (*buffers.arguments, *tile.bounds), (buffers.stride // lanes, tile.rows))
    shape = (*problem.shape[:2], columns)
    return {
        name: values.reshape(shape)[..., :wavelengths] for name, values in zip(names, results, strict=True)
    }
