"""A process that does one job and may be killed at any time: ``python job_process.py FOLDER TABLES``.

Every table that the engine has computed is one line of its output, written before the table is stored.
"""

import asyncio
import os
import sys
from pathlib import Path

from nacreous.engine.in_process import InProcessEngine
from nacreous.engine.work import Product, Work
from nacreous.opencl.tiles import Observer
from small_library import ended, opened, small_sweep


class TellingEngine(InProcessEngine):
    """Writes the id of each table that it has computed."""

    async def compute(
        self, work: Work, observer: Observer | None = None, deadline_s: float | None = None
    ) -> Product:
        """Compute, and tell."""
        product = await super().compute(work, observer, deadline_s)
        os.write(sys.stdout.fileno(), f"{product.id}\n".encode())
        return product


async def do(folder: Path, tables: int) -> None:
    """Do the job to its end."""
    async with opened(folder, engine=TellingEngine()) as rooms:
        await rooms.jobs.start()
        job = await rooms.jobs.add(small_sweep(tables))
        last = await ended(rooms.jobs, job.id)
        print(last.state, last.done, last.failed)


if __name__ == "__main__":
    asyncio.run(do(Path(sys.argv[1]), int(sys.argv[2])))
