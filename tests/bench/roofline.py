"""The roofline of the machine, measured in the same run: multiply-add peak and copy bandwidth."""

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from nacreous.opencl.precision import Precision
from nacreous.opencl.register_width import lane_width

ITEMS, TURNS = 4096, 20_000
CHAINS = 8
"""Independent multiply-adds of as many lanes as a register has."""

COPIED_BYTES = 256 * 2**20
"""Far more than any cache holds."""


@dataclass(frozen=True)
class Roofline:
    """What the device reached on the two simplest kernels."""

    device: str
    flop_per_second: float
    copied_bytes_per_second: float
    """Bytes read plus bytes written."""


def measure_roofline(runs: int = 5) -> Roofline:
    """Measure the device that OpenCL offers first: medians of several runs after a warm-up."""
    import pyopencl as cl

    device = cl.get_platforms()[0].get_devices()[0]
    context = cl.Context([device])
    queue = cl.CommandQueue(context)
    lanes = lane_width(device, Precision.SINGLE)
    program = cl.Program(context, Path(__file__).with_suffix(".cl").read_text()).build([f"-DLANES={lanes}"])
    out, source, target = (
        cl.Buffer(context, cl.mem_flags.READ_WRITE, size) for size in (4 * ITEMS, COPIED_BYTES, COPIED_BYTES)
    )
    cl.enqueue_fill_buffer(queue, source, np.ones(1, np.float32), 0, COPIED_BYTES)
    multiply_add, copy = cl.Kernel(program, "multiply_add"), cl.Kernel(program, "copy")

    def run_multiply_add() -> None:
        multiply_add(queue, (ITEMS,), (16,), out, np.int32(TURNS)).wait()

    def run_copy() -> None:
        copy(queue, (COPIED_BYTES // 64,), (256,), source, target).wait()

    return Roofline(
        device=device.name.strip(),
        flop_per_second=ITEMS * TURNS * CHAINS * lanes * 2 / _median_seconds(run_multiply_add, runs),
        copied_bytes_per_second=2 * COPIED_BYTES / _median_seconds(run_copy, runs),
    )


def _median_seconds(run: Callable[[], None], runs: int) -> float:
    run()  # compiles for this work-group size and touches the pages
    seconds = []
    for _ in range(runs):
        start = time.perf_counter()
        run()
        seconds.append(time.perf_counter() - start)
    return statistics.median(seconds)
