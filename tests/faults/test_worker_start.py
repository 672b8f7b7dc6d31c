"""Machines on which no worker can start: the engine says why in one line, and does not spin."""

import asyncio
from pathlib import Path

import pytest

from nacreous.engine.engine import Readiness
from nacreous.engine.worker_engine import WorkerSettings
from nacreous.errors import UnavailableError
from worker_engines import film_work, patiently, running, until


async def reason_of_failure(settings: WorkerSettings) -> str:
    """Return why no worker starts; works that wait and works that come hear the same."""
    async with running(settings) as engine:
        waiting = asyncio.create_task(engine.compute(film_work()))
        await until(engine, Readiness.FAILED, Readiness.READY)
        assert engine.state.readiness is Readiness.FAILED
        for asked in (waiting, engine.compute(film_work())):
            with pytest.raises(UnavailableError) as refused:
                await asked
            assert str(refused.value) == engine.state.reason
            assert 1 <= refused.value.retry_after_s <= 30
        return engine.state.reason


def test_without_a_platform_the_reason_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A loader of OpenCL that finds no driver: one line, with what to install."""
    monkeypatch.setenv("OCL_ICD_FILENAMES", "")
    monkeypatch.setenv("OCL_ICD_VENDORS", str(tmp_path))
    monkeypatch.setenv("POCL_DEVICES", "nothing")
    reason = patiently(reason_of_failure(WorkerSettings()))
    assert "no OpenCL" in reason
    assert "install" in reason
    assert "\n" not in reason


def test_a_device_that_is_not_there_is_named() -> None:
    """A selector of no device: the reason has those that there are."""
    reason = patiently(reason_of_failure(WorkerSettings(device="abacus")))
    assert "got 'abacus'" in reason


def test_without_a_folder_to_write_the_reason_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Neither the home nor a temporary folder can be written: one line, which names them."""
    (tmp_path / "file").write_text("no folder")
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "file"))
    monkeypatch.setattr("nacreous.engine.kernel_cache._TEMPORARY", (None,))
    reason = patiently(reason_of_failure(WorkerSettings(cache_folder=tmp_path / "file")))
    assert str(tmp_path / "file") in reason
    assert "Not a directory" in reason
    assert "\n" not in reason


def test_a_worker_that_always_dies_is_started_less_and_less_often(tmp_path: Path) -> None:
    """Three starts, then a pause: the reason is how it ended, and the last that it said."""
    starts = tmp_path / "starts"
    command = ("sh", "-c", f"echo start >> {starts}; echo out of luck >&2; exit 3")
    reason = patiently(reason_of_failure(WorkerSettings(command=command, cache_folder=tmp_path / "cache")))
    assert reason == "the worker ended with 3: out of luck"
    assert len(starts.read_text().split()) == 3
