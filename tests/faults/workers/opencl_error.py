"""A worker whose driver refuses to launch a kernel, with the error that it is given.

It does so for as long as the file that it is given has characters, one for each work. What the kernel should
have filled is then memory that nobody has written.
"""

import sys
from pathlib import Path

from nacreous.engine.work import Product, Work, compute
from nacreous.engine.worker import serve
from nacreous.opencl.tiles import Observer

CODE, LEFT = int(sys.argv[1]), Path(sys.argv[2])


def compute_or_fail(work: Work, observer: Observer) -> Product:
    """Compute, with a driver that launches nothing while the file has characters left."""
    import pyopencl as cl

    launch = cl.enqueue_nd_range_kernel

    def refuse(*_: object) -> None:
        record = cl._cl._ErrorRecord("clEnqueueNDRangeKernel", CODE, "")
        raise (
            cl.MemoryError(record)
            if CODE == cl.status_code.MEM_OBJECT_ALLOCATION_FAILURE
            else cl.RuntimeError(record)
        )

    if left := LEFT.read_text():
        LEFT.write_text(left[1:])
        cl.enqueue_nd_range_kernel = refuse
    try:
        return compute(work, observer)
    finally:
        cl.enqueue_nd_range_kernel = launch


if __name__ == "__main__":
    serve(compute_or_fail)
