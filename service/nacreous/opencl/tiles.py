"""Launches in tiles: a table is computed a few rows at a time, each launch well under 250 ms.

Between two tiles the observer hears how far the work is and may raise, which is how it is cancelled: OpenCL
cannot stop a kernel that runs, and ``finish()`` ignores signals.
"""

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import DeviceError
from nacreous.opencl.device import Device

__all__ = ["Observer", "Tile", "TileRunner", "row_tiles", "step_of"]

Observer = Callable[[float], None]
"""Told the fraction done, 0 to 1, after every tile; what it raises ends the work."""

_TARGET_SECONDS = 0.1
_FIRST_TILE_EVALUATIONS = 5_000_000
_MOST_TILE_BYTES = 32 * 2**20
_MOST_GROWTH = 4


def step_of(observer: Observer | None, done: int, steps: int) -> Observer | None:
    """Return an observer of the step after `done` of equally long `steps`."""
    return None if observer is None else lambda fraction: observer((done + fraction) / steps)


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


@dataclass(frozen=True, eq=False)
class TileRunner:
    """A kernel that fills rows of tables, and its output buffers, which all tiles of a table share.

    Parameters
    ----------
    device : Device
    kernel
        Built kernel.
    tables : tuple of float arrays, shape (rows, columns)
        What the kernel fills, in the order of its last arguments.
    stride : int
        Columns of a row on the device, at least as many as the tables have.
    group : tuple of int
        Work-group size; the work is rounded up to whole groups, and a kernel skips what is too much.
    """

    device: Device
    kernel: Any
    tables: tuple[NDArray[Any], ...]
    stride: int
    group: tuple[int, ...]
    _buffers: list[Any] = field(default_factory=list)

    def run(self, tile: Tile, arguments: tuple[Any, ...], work: tuple[int, ...]) -> None:
        """Launch over `work` items, wait, and copy the tile's rows into the tables.

        `arguments` is everything before the outputs.
        """
        import pyopencl as cl

        rounded = tuple(-(-items // local) * local for items, local in zip(work, self.group, strict=True))
        try:
            buffers = self._buffers_of(tile.rows)
            self.kernel.set_args(*arguments, *buffers)
            cl.enqueue_nd_range_kernel(self.device.queue, self.kernel, rounded, self.group).wait()
            for table, buffer in zip(self.tables, buffers, strict=True):
                self._copy(table[tile.origin : tile.origin + tile.rows], buffer)
        except cl.Error as error:
            name = self.kernel.function_name
            raise DeviceError(f"{self.device.info.name} failed in kernel {name}: {error}") from error

    def _buffers_of(self, rows: int) -> list[Any]:
        import pyopencl as cl

        sizes = [rows * self.stride * table.itemsize for table in self.tables]
        if not self._buffers or self._buffers[0].size < sizes[0]:
            flags = cl.mem_flags.WRITE_ONLY
            self._buffers[:] = [cl.Buffer(self.device.context, flags, size) for size in sizes]
        return self._buffers

    def _copy(self, rows: NDArray[Any], buffer: Any) -> None:  # noqa: ANN401 - pyopencl is untyped
        """Copy rows from the device, leaving their padding behind."""
        import pyopencl as cl

        count, columns = rows.shape
        copy: Any = cl.enqueue_copy  # its type stubs lack the rectangular form
        copy(
            self.device.queue,
            rows,
            buffer,
            buffer_origin=(0, 0),
            host_origin=(0, 0),
            region=(columns * rows.itemsize, count),
            buffer_pitches=(self.stride * rows.itemsize,),
            host_pitches=(rows.strides[0],),
            is_blocking=True,
        )
