"""Launches in tiles: a table is computed a few rows at a time, each launch well under 250 ms.

Between two tiles the observer hears how far the work is and may raise, which is how it is cancelled: OpenCL
cannot stop a kernel that runs, and ``finish()`` ignores signals.
"""

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from nacreous.errors import DeviceError
from nacreous.opencl.device import Device

__all__ = ["Observer", "Tile", "TileRunner", "empty_table", "empty_tables", "row_tiles", "step_of"]

Observer = Callable[[float], None]
"""Told the fraction done, 0 to 1, after every tile; what it raises ends the work."""

_TARGET_SECONDS = 0.1
_FIRST_TILE_EVALUATIONS = 5_000_000
_MOST_TILE_BYTES = 32 * 2**20
_MOST_GROWTH = 4
_ALIGNMENT = 128
"""Bytes that the address of a table is a multiple of: at least a `lane` of the kernels, and a cache line."""


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


def empty_table(rows: int, columns: int, dtype: DTypeLike) -> NDArray[Any]:
    """Memory that kernels may fill in place, of shape (rows, columns); its content is undefined."""
    (table,) = empty_tables(1, rows, columns, dtype)
    return table


def empty_tables(count: int, rows: int, columns: int, dtype: DTypeLike) -> tuple[NDArray[Any], ...]:
    """Return `count` tables as `empty_table` does, in one piece of memory.

    From 4 MB on NumPy asks the system for large pages. Pieces below that are given back after every table,
    and the next pays for each page again when it first writes there.
    """
    size = count * rows * columns * np.dtype(dtype).itemsize
    memory = np.empty(size + _ALIGNMENT, np.uint8)
    start = -memory.ctypes.data % _ALIGNMENT
    return tuple(memory[start : start + size].view(dtype).reshape(count, rows, columns))


@dataclass(frozen=True, eq=False)
class TileRunner:
    """A kernel that fills rows of tables.

    Rows without padding are written where they belong; others go through buffers that all tiles share, and
    leave their padding behind.

    Parameters
    ----------
    device : Device
    kernel
        Built kernel.
    tables : tuple of float arrays, shape (rows, columns)
        What the kernel fills, in the order of its last arguments; see `empty_table`.
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
    _staging: list[Any] = field(default_factory=list)

    def run(self, tile: Tile, arguments: tuple[Any, ...], work: tuple[int, ...]) -> None:
        """Launch over `work` items, wait, and leave the tile's rows in the tables.

        `arguments` is everything before the outputs.
        """
        import pyopencl as cl

        rounded = tuple(-(-items // local) * local for items, local in zip(work, self.group, strict=True))
        rows = [table[tile.origin : tile.origin + tile.rows] for table in self.tables]
        padded = any(table.shape[1] < self.stride for table in self.tables)
        try:
            buffers = self._staging_of(tile.rows) if padded else [self._in_place(part) for part in rows]
            self.kernel.set_args(*arguments, *buffers)
            cl.enqueue_nd_range_kernel(self.device.queue, self.kernel, rounded, self.group)
            collect = self._copy if padded else self._bring_home
            for part, buffer in zip(rows, buffers, strict=True):
                collect(part, buffer)
            self.device.queue.finish()
        except cl.Error as error:
            name = self.kernel.function_name
            raise DeviceError(f"{self.device.info.name} failed in kernel {name}: {error}") from error

    def _in_place(self, rows: NDArray[Any]) -> Any:  # noqa: ANN401 - pyopencl is untyped
        """Return a buffer that is the rows themselves, where the device shares the host's memory."""
        import pyopencl as cl

        flags = cl.mem_flags.READ_WRITE | cl.mem_flags.USE_HOST_PTR
        return cl.Buffer(self.device.context, flags, hostbuf=rows)

    def _bring_home(self, rows: NDArray[Any], buffer: Any) -> None:  # noqa: ANN401 - pyopencl is untyped
        """Queue the way home for what a device with its own memory writes: mapping a buffer promises it."""
        import pyopencl as cl

        queue, read = self.device.queue, cl.map_flags.READ
        mapped, _ = cl.enqueue_map_buffer(queue, buffer, read, 0, rows.shape, rows.dtype, is_blocking=False)
        mapped.base.release()

    def _staging_of(self, rows: int) -> list[Any]:
        import pyopencl as cl

        sizes = [rows * self.stride * table.itemsize for table in self.tables]
        if not self._staging or self._staging[0].size < sizes[0]:
            flags = cl.mem_flags.READ_WRITE
            self._staging[:] = [cl.Buffer(self.device.context, flags, size) for size in sizes]
        return self._staging

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
