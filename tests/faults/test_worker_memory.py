"""A machine with little memory: what does not fit is refused unbegun, and the service lives on."""

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
