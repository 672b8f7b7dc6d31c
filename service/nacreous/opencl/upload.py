"""Buffers of the device, filled from arrays or to be filled by kernels."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.device import Device

__all__ = ["empty_buffer", "upload"]


def upload(device: Device, array: NDArray[Any], dtype: Any) -> Any:  # noqa: ANN401 - pyopencl is untyped
    """Copy an array into a new read-only buffer of the device."""
    import pyopencl as cl

    flags = cl.mem_flags.READ_ONLY | cl.mem_flags.COPY_HOST_PTR
    return cl.Buffer(device.context, flags, hostbuf=np.ascontiguousarray(array, dtype))


def empty_buffer(device: Device, shape: tuple[int, ...], dtype: Any) -> Any:  # noqa: ANN401 - pyopencl is untyped
    """Return a buffer for as many numbers, which kernels write and read."""
    import pyopencl as cl

    size = math.prod(shape) * np.dtype(dtype).itemsize
    return cl.Buffer(device.context, cl.mem_flags.READ_WRITE, size)
