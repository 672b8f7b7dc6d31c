"""Works that end their worker, and drivers that fail: nothing wrong comes of it, and it does not go on."""

from pathlib import Path

import pytest

from faults.soak import scale
from nacreous.engine.work import compute
from nacreous.errors import DeviceError, UnavailableError
from nacreous.formats.names import FormatName
from worker_engines import faulty, film_work, patiently, running

CODES = {
    -4: "MEM_OBJECT_ALLOCATION_FAILURE",
    -5: "OUT_OF_RESOURCES",
    -6: "OUT_OF_HOST_MEMORY",
    -14: "EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST",
    -36: "INVALID_COMMAND_QUEUE",
}
"""Errors of a driver whose context is not to be trusted afterwards (cl.h)."""
SHORT_CODES = (-5, -36)


def test_a_work_that_has_ended_two_workers_is_not_run_again(tmp_path: Path) -> None:
    """The second attempt crashes too: later requests for the same file are refused, all others done."""
    begun = tmp_path / "begun"
    crashing = film_work(1001.0)

    async def crashed() -> None:
        async with running(faulty("crashing", str(begun), cache_folder=tmp_path / "cache")) as engine:
            with pytest.raises(UnavailableError, match="lost twice") as lost:
                await engine.compute(crashing)
            assert lost.value.retry_after_s <= 3
            assert begun.read_text().split() == 2 * [crashing.id]
            for _ in range(3):
                with pytest.raises(UnavailableError, match="ended its worker 2 times") as refused:
                    await engine.compute(crashing)
                assert 590 < refused.value.retry_after_s <= 600
            assert begun.read_text().split() == 2 * [crashing.id]
            assert (await engine.compute(film_work())).files
            assert engine.restarts == 2
            assert engine.kernel_wipes == 1

    patiently(crashed())


def test_workers_that_end_one_after_the_other_do_not_take_the_service_along(tmp_path: Path) -> None:
    """Many works that each end two workers: the next good one is done."""

    async def crashed() -> None:
        async with running(faulty("crashing", str(tmp_path / "begun"))) as engine:
            for number in range(scale(1, 20)):
                with pytest.raises(UnavailableError, match="lost twice"):
                    await engine.compute(film_work(1001.0 + number))
            assert (await engine.compute(film_work())).files

    patiently(crashed())


@pytest.mark.parametrize("code", CODES if scale(0, 1) else SHORT_CODES)
def test_a_driver_that_fails_costs_its_worker_and_nothing_else(code: int, tmp_path: Path) -> None:
    """After an error of OpenCL another worker does the work; the file is the right one."""
    left = tmp_path / "left"
    left.write_text("x")
    expected = compute(film_work(form=FormatName.NPZ)).files

    async def failed() -> None:
        async with running(faulty("opencl_error", str(code), str(left))) as engine:
            assert (await engine.compute(film_work(form=FormatName.NPZ))).files == expected
            assert (engine.restarts, left.read_text()) == (1, "")

    patiently(failed())


def test_a_driver_that_keeps_failing_is_told_of(tmp_path: Path) -> None:
    """The error of the second attempt reaches the caller by its name, and nothing is computed."""
    left = tmp_path / "left"
    left.write_text("xx")

    async def failed() -> None:
        async with running(faulty("opencl_error", "-5", str(left))) as engine:
            with pytest.raises(DeviceError, match=CODES[-5]):
                await engine.compute(film_work())
            assert engine.computed == 0
            assert (await engine.compute(film_work(410.0))).files

    patiently(failed())
