"""Compiled kernels that are damaged or cannot be kept: the worker is ready nevertheless, and does not loop.

PoCL ends its process over a damaged kernel (SIGABRT, SIGBUS or SIGSEGV by its kind) and over a full disk.
"""

import asyncio
import os
import shutil
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from faults.soak import scale
from nacreous.engine.engine import Readiness
from nacreous.engine.kernel_cache import take_cache
from nacreous.engine.worker_engine import WorkerEngine, WorkerSettings
from worker_engines import film_work, patiently, running, until

BEYOND_COMPILING_S = 5.0
THIN = film_work(100.0, size=128)
"""A film that is thin, and large: its kernels are none that a start compiles."""


def truncated(kernel: bytes) -> bytes:
    """Return the first half."""
    return kernel[: len(kernel) // 2]


def zeroed(kernel: bytes) -> bytes:
    """Return as many zeros."""
    return bytes(len(kernel))


def garbage(kernel: bytes) -> bytes:
    """Return as many bytes of any value."""
    return os.urandom(len(kernel))


DAMAGES = (zeroed, truncated, garbage)


async def seconds_until_ready(settings: WorkerSettings) -> float:
    """Start an engine, see a work done, and return how long it took to be ready."""
    began_s = time.monotonic()
    async with running(settings) as engine:
        await until(engine, Readiness.READY, Readiness.FAILED)
        assert engine.state.readiness is Readiness.READY, engine.state.reason
        ready_s = time.monotonic() - began_s
        assert (await engine.compute(film_work())).files
        return ready_s


@pytest.fixture(scope="module")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, float]:
    """Return a folder of caches with kernels, and how long a worker took that had to compile them."""
    folder = tmp_path_factory.mktemp("compiled")
    return folder, patiently(seconds_until_ready(WorkerSettings(cache_folder=folder)))


@contextmanager
def mounted(folder: Path, options: str) -> Iterator[Path]:
    """Mount a file system in memory, or skip where this user may not."""
    folder.mkdir()
    command = ["/bin/mount", "-t", "tmpfs", "-o", options, "tmpfs", str(folder)]
    if not Path(command[0]).exists() or subprocess.run(command, capture_output=True, check=False).returncode:
        pytest.skip("a full or read-only file system needs root and the right to mount")
    try:
        yield folder
    finally:
        subprocess.run(["/bin/umount", "--lazy", str(folder)], check=True)


def test_a_second_start_finds_the_kernels(compiled: tuple[Path, float]) -> None:
    """Kernels are kept between starts: a second start writes no new one."""
    folder, _ = compiled
    kernels = {path: path.stat().st_mtime_ns for path in folder.rglob("*.so")}
    assert kernels
    patiently(seconds_until_ready(WorkerSettings(cache_folder=folder)))
    assert kernels == {path: path.stat().st_mtime_ns for path in folder.rglob("*.so")}


@pytest.mark.parametrize("damage", DAMAGES[: scale(1, 3)])
def test_damaged_kernels_are_compiled_again(
    damage: Callable[[bytes], bytes], compiled: tuple[Path, float], tmp_path: Path
) -> None:
    """All kernels are damaged: one wipe, and the worker is ready 5 s after compiling at the latest."""
    folder, cold_s = compiled
    shutil.copytree(folder, tmp_path / "cache")
    for kernel in (tmp_path / "cache").rglob("*.so"):
        kernel.write_bytes(damage(kernel.read_bytes()))

    async def started() -> float:
        began_s = time.monotonic()
        async with running(WorkerSettings(cache_folder=tmp_path / "cache")) as engine:
            await until(engine, Readiness.READY, Readiness.FAILED)
            ready_s = time.monotonic() - began_s
            assert engine.state.readiness is Readiness.READY, engine.state.reason
            assert engine.kernel_wipes == 1
            assert (await engine.compute(film_work())).files
            assert engine.restarts == 0
        return ready_s

    assert patiently(started()) < cold_s + scale(60, 1) * BEYOND_COMPILING_S


def test_a_damaged_kernel_that_is_used_late_costs_one_worker(
    compiled: tuple[Path, float], tmp_path: Path
) -> None:
    """A kernel that no start uses is damaged: the work that first needs it is done all the same."""
    cache = tmp_path / "cache"
    shutil.copytree(compiled[0], cache)
    before = set(cache.rglob("*.so"))

    async def computed(losses: int) -> None:
        async with running(WorkerSettings(cache_folder=cache)) as engine:
            assert (await engine.compute(THIN)).files
            assert (engine.kernel_wipes, engine.restarts) == (losses, losses)

    patiently(computed(losses=0))
    late = set(cache.rglob("*.so")) - before
    assert late
    for kernel in late:
        kernel.write_bytes(truncated(kernel.read_bytes()))
    patiently(computed(losses=1))


def test_cold_starts_at_once_do_not_hurt_one_another(tmp_path: Path) -> None:
    """Each has a folder of its own; none crashes, and none finds what another has half written."""
    settings = WorkerSettings(cache_folder=tmp_path, start_s=120)
    engines = [WorkerEngine(settings) for _ in range(scale(2, 6))]

    async def started(engine: WorkerEngine) -> None:
        await engine.start()
        await until(engine, Readiness.READY, Readiness.FAILED)
        assert (engine.state.readiness, engine.kernel_wipes) == (Readiness.READY, 0), engine.state.reason
        assert (await engine.compute(film_work())).files
        await engine.stop()

    async def all_started() -> None:
        await asyncio.gather(*map(started, engines))

    patiently(all_started())
    assert len(list(tmp_path.glob("*/*.lock"))) == len(engines)


@pytest.mark.parametrize("options", ["size=1m", "size=64m,ro"])
def test_a_disk_that_takes_no_kernels_is_not_used(options: str, tmp_path: Path) -> None:
    """A full or a read-only disk: kernels are compiled into a temporary folder, which is gone afterwards."""
    with mounted(tmp_path / "disk", options) as disk:
        cache = take_cache(disk)
        assert not cache.folder.is_relative_to(disk)
        assert cache.usable
        cache.release()
        assert not cache.folder.exists()
        for _ in range(scale(0, 1)):
            patiently(seconds_until_ready(WorkerSettings(cache_folder=disk)))


def test_a_home_that_is_none_is_not_needed(tmp_path: Path) -> None:
    """Where the user's caches cannot be, a temporary folder serves, and the worker is ready."""
    (tmp_path / "home").write_text("no folder")
    patiently(seconds_until_ready(WorkerSettings(cache_folder=tmp_path / "home" / "cache")))


def test_a_disk_that_fills_up_is_left(compiled: tuple[Path, float], tmp_path: Path) -> None:
    """The disk is full when a worker must be replaced: the next one has its kernels elsewhere."""
    with mounted(tmp_path / "disk", "size=64m") as disk:
        shutil.copytree(compiled[0], disk, dirs_exist_ok=True)

        async def filled() -> None:
            async with running(WorkerSettings(cache_folder=disk)) as engine:
                assert (await engine.compute(film_work())).files
                (disk / "ballast").write_bytes(bytes(shutil.disk_usage(disk).free - 4096))
                assert engine.worker_pid is not None
                os.kill(engine.worker_pid, 9)
                assert (await engine.compute(film_work())).files
                assert (engine.restarts, engine.kernel_wipes) == (1, 0)

        patiently(filled())
