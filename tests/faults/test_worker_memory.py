"""A machine with little memory: what does not fit is refused unbegun, and the service lives on."""

from pathlib import Path

import pytest

from nacreous.engine.worker_engine import WorkerSettings
from nacreous.errors import BudgetError
from nacreous.formats.names import FormatName
from worker_engines import film_work, patiently, running

GIB = 2**30


def test_a_table_beyond_the_memory_is_refused() -> None:
    """Within 2 GiB of address space, a table of 1 GB is refused by its size, and the worker lives on."""
    large = film_work(size=1400, form=FormatName.NPZ)
    assert GIB < 1400 * 1400 * 81 * 4 * 2

    async def capped() -> None:
        async with running(WorkerSettings(memory_cap=2 * GIB)) as engine:
            with pytest.raises(BudgetError) as refused:
                await engine.compute(large)
            assert refused.value.needed_bytes > refused.value.limit_bytes
            assert refused.value.limit_bytes < GIB
            assert (await engine.compute(film_work())).files
            assert engine.restarts == 0

    patiently(capped())


def test_the_memory_of_arrays_is_kept() -> None:
    """Tables like those before, of the same kernels, need no new pages, which the system would clear."""

    async def counted() -> int:
        async with running() as engine:
            for table in range(4):
                await engine.compute(film_work(100 + table, size=128))
            assert engine.worker_pid
            before = page_faults(engine.worker_pid)
            for table in range(4):
                await engine.compute(film_work(104 + table, size=128))
            return page_faults(engine.worker_pid) - before

    assert patiently(counted()) < 500  # 7,500 where arrays are given back


def page_faults(pid: int) -> int:
    """Return how many pages a process has been given by now; see proc_pid_stat(5), minflt."""
    return int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[7])
