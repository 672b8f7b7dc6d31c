"""Arrays on their way to the device."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.device import Device

__all__ = ["upload"]


def upload(device: Device, array: NDArray[Any], dtype: Any) -> Any:  # noqa: ANN401 - pyopencl is untyped
    """Copy an array into a new read-only buffer of the device."""
    import pyopencl as cl

    flags = cl.mem_flags.READ_ONLY | cl.mem_flags.COPY_HOST_PTR
    return cl.Buffer(device.context, flags, hostbuf=np.ascontiguousarray(array, dtype))
