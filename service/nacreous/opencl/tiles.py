"""Launches in tiles: a table is computed a few rows at a time, each launch well under 250 ms.

Between two tiles the observer hears how far the work is and may raise, which is how it is cancelled: OpenCL
cannot stop a kernel that runs, and ``finish()`` ignores signals.
"""

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from nacreous.errors import DeviceError
from nacreous.opencl.device import Device

__all__ = ["Observer", "Tile", "row_tiles", "run_tile"]

Observer = Callable[[float], None]
"""Told the fraction done, 0 to 1, after every tile; what it raises ends the work."""

_TARGET_SECONDS = 0.1
_FIRST_TILE_EVALUATIONS = 2_000_000
_MOST_TILE_BYTES = 32 * 2**20
_MOST_GROWTH = 4


@dataclass(frozen=True)
class Tile:
    """Rows `origin` to `origin` + `rows` - 1."""

    origin: int
    rows: int

    @property
    def bounds(self) -> tuple[np.int32, np.int32]:
        """First row and the row after the last, as the kernels take them."""
        return np.int32(self.origin), np.int32(self.origin + self.rows)


def row_tiles(
    rows: int, evaluations_a_row: int, bytes_a_row: int, observer: Observer | None
) -> Iterator[Tile]:
    """Yield tiles that cover all rows, each sized by how long the one before took.

    Parameters
    ----------
    rows : int
    evaluations_a_row, bytes_a_row : int
        Work of a row, by which the first tile is sized, and its output, which bounds every tile.
    observer : Observer, optional
    """
    most = max(1, _MOST_TILE_BYTES // bytes_a_row)
    size = min(most, max(1, _FIRST_TILE_EVALUATIONS // evaluations_a_row))
    origin = 0
    while origin < rows:
        tile = Tile(origin, min(size, rows - origin))
        began = time.perf_counter()
        yield tile
        seconds = time.perf_counter() - began
        origin += tile.rows
        if observer is not None:
            observer(origin / rows)
        growth = min(_MOST_GROWTH, _TARGET_SECONDS / max(seconds, 1e-6))
        size = min(most, max(1, int(size * growth)))


def run_tile(
    device: Device,
    kernel: Any,  # noqa: ANN401 - pyopencl is untyped
    arguments: tuple[Any, ...],
    work: tuple[int, ...],
    group: tuple[int, ...],
    outputs: list[tuple[tuple[int, ...], DTypeLike]],
) -> list[NDArray[Any]]:
    """Launch a kernel over `work` items, wait, and return its outputs.

    Parameters
    ----------
    arguments : tuple
        Everything before the outputs.
    work, group : tuple of int
        Global size, rounded up to whole work-groups, and local size; a kernel skips what is too much.
    outputs : list of (shape, dtype)
        One buffer each, in the kernel's order.
    """
    import pyopencl as cl

    hosts = [np.empty(shape, dtype) for shape, dtype in outputs]
    rounded = tuple(-(-items // local) * local for items, local in zip(work, group, strict=True))
    try:
        buffers = [cl.Buffer(device.context, cl.mem_flags.WRITE_ONLY, host.nbytes) for host in hosts]
        kernel.set_args(*arguments, *buffers)
        cl.enqueue_nd_range_kernel(device.queue, kernel, rounded, group).wait()
        for host, buffer in zip(hosts, buffers, strict=True):
            cl.enqueue_copy(device.queue, host, buffer, is_blocking=True)
    except cl.Error as error:
        raise DeviceError(f"{device.info.name} failed in kernel {kernel.function_name}: {error}") from error
    return hosts
