"""A writer that is killed leaves no part of an entry, and nothing that is not swept later."""

import subprocess
import sys
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

from faults import store_crashes
from faults.soak import scale
from faults.store_crashes import KEY, NEW, OLD, OTHERS
from faults.store_traffic import KEYS, is_whole, put_for_ever
from nacreous.store.entry import Entry
from nacreous.store.store import Store, open_store

KILLS = scale(3, 100)
LARGEST = 500_000
ROOMY, TIGHT = 100_000, 3 * len(OLD.to_bytes(KEY)) + 10
"""Quotas within which the put finds room, and has to make it."""


def hidden_in(folder: Path) -> list[Path]:
    """Return what writers have under way, or have left."""
    return list(folder.rglob(".nacreous-*.part"))


def bytes_in(folder: Path) -> int:
    """Return the size of all files but the ledger."""
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file() and path.name != ".lock")


@pytest.mark.parametrize("quota", [ROOMY, TIGHT])
def test_killed_at_any_step(tmp_path: Path, quota: int) -> None:
    """The old entry is there or the new one, whole; the next writer clears away what is left."""
    command = [sys.executable, store_crashes.__file__, str(tmp_path), str(quota)]
    steps = int(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    assert steps > 10  # at least a file opened, sized, locked and renamed, and the ledger twice
    found = [state_of(tmp_path / str(step), quota) for step in range(1, steps + 1)]
    assert {OLD.facts["age"], NEW.facts["age"]} <= set(found)
    assert found[-1] == "new"


def state_of(folder: Path, quota: int) -> str | None:
    """Return which entry a killed writer has left, and check that all else is in order."""
    assert len(hidden_in(folder)) <= 1
    assert bytes_in(folder) <= quota
    store = open_store(str(folder), quota)
    left = store.get(KEY)
    assert left in (OLD, NEW, None)
    assert all(store.get(key) in (OLD, None) for key in OTHERS)
    store.put("tables/later", Entry({}, b"later"))
    assert (hidden_in(folder), store.quarantined) == ([], 0)
    assert store.size_bytes() == bytes_in(folder) <= quota
    return left and left.facts["age"]


def test_killed_at_any_time(tmp_path: Path) -> None:
    """However often and wherever in a long row of large puts: every entry found is whole."""
    random, quota = np.random.default_rng(9), 20 * LARGEST
    for seed in range(KILLS):
        kill_while_putting(tmp_path, quota, seed, after=int(random.integers(1, 20)))
        assert len(hidden_in(tmp_path)) <= 1  # the one before has been swept by the writer that came after it
        assert bytes_in(tmp_path) <= quota
        assert_whole(open_store(str(tmp_path)))


def kill_while_putting(folder: Path, quota: int, seed: int, after: int) -> None:
    """Kill a process that puts entries, at some moment after a number of them."""
    spawn = get_context("spawn")
    receiver, sender = spawn.Pipe(duplex=False)
    process = spawn.Process(target=put_for_ever, args=(str(folder), quota, LARGEST, seed, sender))
    process.start()
    for _ in range(after):
        assert receiver.recv() in KEYS
    process.kill()
    process.join()


def assert_whole(store: Store) -> None:
    """Check every entry of a store by its own law."""
    keys = list(store.keys())
    assert keys
    entries = {key: store.get(key) for key in keys}
    assert all(entry is not None and is_whole(key, entry) for key, entry in entries.items())
