"""A worker that a film thicker than 1,000 nm ends, as a driver does that reads where there is nothing.

Every work that it begins is a line in the file that it is given.
"""

import ctypes
import sys
from pathlib import Path

from nacreous.engine.work import Product, Work, compute
from nacreous.engine.worker import serve
from nacreous.opencl.tiles import Observer

LIMIT_NM = 1000.0


def compute_or_crash(work: Work, observer: Observer) -> Product:
    """Compute, or read at address 0."""
    with Path(sys.argv[1]).open("a") as begun:
        begun.write(f"{work.id}\n")
    if work.spec.stack.layers[0].thickness_nm > LIMIT_NM:
        ctypes.string_at(0)
    return compute(work, observer)


if __name__ == "__main__":
    serve(compute_or_crash)
