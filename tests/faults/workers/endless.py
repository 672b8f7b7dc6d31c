"""A worker whose kernel never ends, for films thicker than 1,000 nm."""

from nacreous.engine.work import Product, Work, compute
from nacreous.engine.worker import serve
from nacreous.opencl.device import open_device
from nacreous.opencl.tiles import Observer

LIMIT_NM = 1000.0
SOURCE = "kernel void endless(volatile global int *go) { while (*go) { } }"


def compute_or_hang(work: Work, observer: Observer) -> Product:
    """Compute, or launch a kernel that waits for a number that nobody writes."""
    if work.spec.stack.layers[0].thickness_nm > LIMIT_NM:
        observer(0.5)
        _hang()
    return compute(work, observer)


def _hang() -> None:
    import numpy as np
    import pyopencl as cl

    device = open_device()
    go = cl.Buffer(device.context, cl.mem_flags.COPY_HOST_PTR, hostbuf=np.ones(1, np.int32))
    cl.Program(device.context, SOURCE).build().endless(device.queue, (1,), (1,), go)
    device.queue.finish()


if __name__ == "__main__":
    serve(compute_or_hang)
