"""How wide a device's vectors are: the host of kernels/register_width.cl.

What a device prefers is what its processor has. What its compiler makes use of can be less, and lanes that
are wider than its registers do not build.
"""

import functools
from typing import Any

import numpy as np

from nacreous.opencl.precision import Precision
from nacreous.opencl.sources import complete_source

__all__ = ["LANE_WIDTHS", "lane_width"]

LANE_WIDTHS = (16, 8, 4, 1)
"""Lane widths that the kernels are built for."""


def lane_width(device: Any, precision: Precision) -> int:  # noqa: ANN401 - pyopencl is untyped
    """Return how many numbers of `precision` a work-item takes on a `pyopencl.Device`.

    That is the preferred vector width, as far as the compiler has registers for it; 1 on GPUs.
    """
    single = precision is Precision.SINGLE
    preferred = device.preferred_vector_width_float if single else device.preferred_vector_width_double
    if preferred > 1:
        bits = _register_bits(device)
        preferred = min(preferred, bits // precision.value) if bits else preferred
    return next(width for width in LANE_WIDTHS if width <= max(1, preferred))


@functools.cache
def _register_bits(device: Any) -> int:  # noqa: ANN401 - pyopencl is untyped
    """Ask the compiler; 0 where it does not say, or does not work: then the first real kernel tells why."""
    import pyopencl as cl

    bits = np.zeros(1, np.int32)
    try:
        context = cl.Context([device])
        queue = cl.CommandQueue(context)
        kernel = cl.Kernel(cl.Program(context, complete_source("register_width")).build(), "register_width")
        result = cl.Buffer(context, cl.mem_flags.WRITE_ONLY, bits.nbytes)
        kernel.set_args(result)
        cl.enqueue_nd_range_kernel(queue, kernel, (1,), (1,))
        cl.enqueue_copy(queue, bits, result)
    except cl.Error:
        return 0
    return int(bits[0])
