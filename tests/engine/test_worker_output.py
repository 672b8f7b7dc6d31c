"""What a worker and its driver print is logged, and never taken for an answer."""

import logging

import pytest

from worker_engines import faulty, film_work, patiently, running


def test_what_the_driver_prints_is_logged(caplog: pytest.LogCaptureFixture) -> None:
    """C's printf and Python's stderr reach the log line by line, and the files are whole."""
    caplog.set_level(logging.INFO, "nacreous.engine.worker")

    async def computed() -> None:
        async with running(faulty("chatty")) as engine:
            assert (await engine.compute(film_work())).files
            assert engine.restarts == 0

    patiently(computed())
    lines = [record.getMessage() for record in caplog.records]
    assert "printed by the driver" in lines
    assert "said on stderr: å" in lines
    assert max(map(len, lines)) <= 2000
