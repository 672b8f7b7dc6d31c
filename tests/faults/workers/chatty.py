"""A worker whose driver prints, as a debugging build of PoCL does."""

import ctypes
import sys

from nacreous.engine.work import Product, Work, compute
from nacreous.engine.worker import serve
from nacreous.opencl.tiles import Observer


def print_and_compute(work: Work, observer: Observer) -> Product:
    """Print with C's library, in one long line too, and compute."""
    library = ctypes.CDLL(None)
    library.puts(b"printed by the driver")
    library.fflush(None)
    print("said on stderr: å", file=sys.stderr)
    print("x" * 3_000_000, file=sys.stderr, flush=True)
    return compute(work, observer)


if __name__ == "__main__":
    serve(print_and_compute)
