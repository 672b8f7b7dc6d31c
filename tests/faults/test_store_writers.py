"""Many processes write to one store, evict each other's entries, and read: nothing torn, nothing too much."""

from collections.abc import Iterator
from concurrent.futures import Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from multiprocessing import get_context
from pathlib import Path

from faults.soak import scale
from faults.store_traffic import Readings, put_until, read
from nacreous.store.ledger import held
from nacreous.store.store import open_store

WRITERS, READERS = 8, 2
READINGS = scale(4_000, 100_000)
LARGEST = 20_000
QUOTA = 60 * LARGEST
"""Of 200 keys, each with 10,000 bytes on average, three in five find room."""
LOOK_S = 0.05
"""How often the folder is measured: all writers wait meanwhile."""


@contextmanager
def writers(folder: Path, count: int) -> Iterator[list[Future[int]]]:
    """Let processes write to a store during the block."""
    with (
        get_context("spawn").Manager() as manager,
        ProcessPoolExecutor(count, get_context("spawn")) as processes,
    ):
        done = manager.Event()
        seeds = range(count)
        running = [processes.submit(put_until, str(folder), QUOTA, LARGEST, seed, done) for seed in seeds]
        try:
            yield running
        finally:
            done.set()


def bytes_in(folder: Path) -> int:
    """Return the size of all files but the ledger at one moment: holding it holds up every change."""
    with held(folder):
        return sum(
            path.stat().st_size for path in folder.rglob("*") if path.is_file() and path.name != ".lock"
        )


def test_no_reading_is_torn_and_the_quota_is_kept(tmp_path: Path) -> None:
    """Eight writers with eviction; a promise of the service's design: size <= quota + one entry."""
    store = open_store(str(tmp_path), QUOTA)
    store.check_writable()
    sizes, each = [], READINGS // READERS
    with (
        ProcessPoolExecutor(READERS, get_context("spawn")) as processes,
        writers(tmp_path, WRITERS) as writing,
    ):
        reading = [processes.submit(read, str(tmp_path), each, seed) for seed in range(READERS)]
        while wait(reading, LOOK_S).not_done:
            sizes.append(bytes_in(tmp_path))
    assert_sound([future.result() for future in reading])
    assert all(future.result() > 0 for future in writing)
    assert 0 < max(sizes) <= QUOTA
    assert bytes_in(tmp_path) == store.size_bytes()
    assert len(list(store.keys())) == sum(path.suffix == ".exr" for path in tmp_path.rglob("*"))


def assert_sound(readings: list[Readings]) -> None:
    """Check that entries have been found, all of them whole, and that some had been evicted."""
    assert sum(reading.torn + reading.quarantined for reading in readings) == 0
    assert sum(reading.whole for reading in readings) > 0
    assert sum(reading.absent for reading in readings) > 0
