"""Points of the unit square, warped to densities: the host of kernels/warp.cl."""

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.opencl.tiles import Observer, TileRunner, empty_tables, row_tiles
from nacreous.opencl.upload import upload
from nacreous.optics.square_density import SquareDensities

__all__ = ["warped"]

_EVALUATIONS = 20
"""What a point costs, in evaluations of a layer: two binary searches."""


def warped(
    device: Device,
    densities: SquareDensities,
    points: NDArray[np.float64],
    precision: Precision,
    *,
    observer: Observer | None = None,
) -> NDArray[np.floating]:
    """Return x and y, (S, P, 2), of points (P, 2) of the square after the warp of each of S densities.

    Raises
    ------
    BudgetError
        The result is larger than the byte budget; nothing is allocated.
    """
    slices, height, width = densities.density.shape
    count = slices * len(points)
    item = np.dtype(precision.dtype).itemsize
    require(f"{slices:,} x {len(points):,} points of a square", 2 * count * item)
    kernel = kernel_of(device, Build("warp", precision, 1))
    arguments = (
        *(
            upload(device, values, precision.dtype)
            for values in (densities.density, densities.conditional, densities.marginal)
        ),
        np.int32(height),
        np.int32(width),
        upload(device, points, precision.dtype),
        np.int32(len(points)),
    )
    results = empty_tables(2, count, 1, precision.dtype)
    runner = TileRunner(device, kernel, results, 1, (1,))
    for tile in row_tiles(count, _EVALUATIONS, 2 * item, observer):
        runner.run(tile, (*arguments, *tile.bounds), (tile.rows,))
    return np.stack([values.reshape(slices, -1) for values in results], axis=-1)
