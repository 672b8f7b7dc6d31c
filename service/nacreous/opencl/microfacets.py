"""D and the projected area of a rough surface's facets: the host of kernels/microfacets.cl."""

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.budget import require
from nacreous.opencl.device import Device
from nacreous.opencl.microsurface import Microsurface, surface_arguments
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.opencl.tiles import TileRunner, empty_table, row_tiles
from nacreous.opencl.upload import upload

__all__ = ["microfacets"]


def microfacets(
    device: Device,
    surface: Microsurface,
    directions: NDArray[np.float64],
    precision: Precision,
    *,
    lanes: int | None = None,
) -> tuple[NDArray[np.floating], NDArray[np.floating]]:
    """D in 1 / sr, and the area of the facets that face a direction, projected along it.

    Parameters
    ----------
    surface : Microsurface
        Of any distribution but ``"phong"``, which is none of facets.
    directions : float array, shape (P, 3)
        Unit vectors above the surface, z > 0.

    Returns
    -------
    density, area : float arrays, shape (R, P)

    Raises
    ------
    BudgetError
        The two arrays are larger than the byte budget; nothing is allocated.
    """
    count, roughnesses = len(directions), len(surface.alphas)
    item = np.dtype(precision.dtype).itemsize
    require(f"{roughnesses} x {count:,} microfacets", 2 * roughnesses * count * item)
    lanes = lanes or device.lanes(precision)
    kernel = kernel_of(device, Build("microfacets", precision, lanes, surface.build_numbers))
    padded = np.pad(directions, ((0, -count % lanes), (0, 0)), mode="edge")
    arguments = (
        *surface_arguments(device, surface, precision),
        upload(device, padded.T, precision.dtype),
        np.int32(len(padded)),
    )
    rows = roughnesses * len(padded) // lanes
    results = tuple(empty_table(rows, lanes, precision.dtype) for _ in range(2))
    runner = TileRunner(device, kernel, results, lanes, (1,))
    for tile in row_tiles(rows, lanes, 2 * lanes * item, None):
        runner.run(tile, (*arguments, *tile.bounds), (tile.rows,))
    density, area = (values.reshape(roughnesses, -1)[:, :count] for values in results)
    return density, area
