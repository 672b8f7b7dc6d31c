"""A folder stays within its quota, and what was used the longest ago goes first."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nacreous.errors import StoreError
from nacreous.store.entry import Entry
from nacreous.store.store import open_store

KIBIBYTE = 1024


def entry(size: int) -> Entry:
    """Return an entry of a number of bytes and its few facts."""
    return Entry({}, bytes(size))


def stored_size(size: int) -> int:
    """Return what such an entry takes: SHA-256 in hex, two line ends and an empty object of JSON."""
    return size + 64 + 2 + 2


def on_disk(folder: Path) -> int:
    """Return what a folder holds, as anybody would count it: all files but jobs and the ledger."""
    files = (path for path in folder.rglob("*") if path.is_file() and path.name != ".lock")
    return sum(path.stat().st_size for path in files if path.relative_to(folder).parts[0] != "jobs")


def let_time_pass(folder: Path) -> None:
    """Make every entry a minute older: marks of use that are finer than some seconds are not kept."""
    for path in folder.rglob("*"):
        if path.is_file():
            used_ns = path.stat().st_mtime_ns - 60 * 10**9
            os.utime(path, ns=(used_ns, used_ns))


LARGEST = 2000
USE = st.tuples(st.sampled_from(["put", "get"]), st.integers(0, 7), st.integers(LARGEST // 4, LARGEST))


@settings(deadline=None, max_examples=60)
@given(uses=st.lists(USE, min_size=8, max_size=30))
def test_keeps_what_was_used_last(
    tmp_path_factory: pytest.TempPathFactory, uses: list[tuple[str, int, int]]
) -> None:
    """The entries left are the last in the order of use, within the quota, and none went without need."""
    folder, quota, order, sizes = tmp_path_factory.mktemp("store"), 8 * KIBIBYTE, [], {}
    store, needed = open_store(str(folder), quota), quota - quota // 16 - stored_size(LARGEST)
    for use, number, size in uses:
        key = f"tables/{number}"
        if use == "put":
            store.put(key, entry(size))
            sizes[key] = stored_size(size)
        if use == "put" or store.get(key):
            order = [*(other for other in order if other != key), key]
        kept = [key for key in order if store.has(key)]
        assert kept == order[len(order) - len(kept) :]
        assert on_disk(folder) == store.size_bytes() == sum(sizes[key] for key in kept) <= quota
        if len(kept) < len(order):
            assert sum(sizes[key] for key in order[-len(kept) - 1 :]) > needed
        order = kept
        let_time_pass(folder)


def test_reading_an_entry_keeps_it(tmp_path: Path) -> None:
    """The one that has been read outlives those that were put after it."""
    store = open_store(str(tmp_path), 3 * stored_size(100))
    for number in range(3):
        store.put(f"tables/{number}", entry(100))
        let_time_pass(tmp_path)
    assert store.get("tables/0") == entry(100)
    store.put("tables/3", entry(100))
    assert sorted(store.keys()) in (["tables/0", "tables/3"], ["tables/0", "tables/2", "tables/3"])


def test_no_entry_goes_while_there_is_room(tmp_path: Path) -> None:
    """The quota may be filled to its last byte."""
    store = open_store(str(tmp_path), 4 * stored_size(100))
    for number in range(4):
        store.put(f"tables/{number}", entry(100))
    assert (store.size_bytes(), store.evicted) == (4 * stored_size(100), 0)
    store.put("tables/4", entry(0))
    assert (store.has("tables/0"), store.has("tables/4"), store.evicted) == (False, True, 1)


def test_refuses_what_would_never_fit(tmp_path: Path) -> None:
    """It says so, and nothing has gone for it."""
    store = open_store(str(tmp_path), KIBIBYTE)
    store.put("tables/0", entry(500))
    with pytest.raises(StoreError, match="within the store's quota of 1024 bytes, got one of 1025"):
        store.put("tables/1", entry(KIBIBYTE + 1 - stored_size(0)))
    assert (list(store.keys()), store.evicted, on_disk(tmp_path)) == (["tables/0"], 0, stored_size(500))
    store.put("tables/1", entry(KIBIBYTE - stored_size(0)))
    assert list(store.keys()) == ["tables/1"]


def test_replacing_an_entry_takes_only_the_difference(tmp_path: Path) -> None:
    """Once the new one is in place, the old one counts no more."""
    store = open_store(str(tmp_path), 10 * KIBIBYTE)
    for size in (3000, 1000, 2000):
        store.put("tables/0", entry(size))
        assert store.size_bytes() == on_disk(tmp_path) == stored_size(size)
    assert store.evicted == 0


def test_jobs_neither_count_nor_go(tmp_path: Path) -> None:
    """A manifest may be larger than the quota, and outlives every table."""
    store = open_store(str(tmp_path), KIBIBYTE)
    store.put("jobs/ab12", entry(5000))
    for number in range(20):
        store.put(f"tables/{number}", entry(500))
    assert (store.get("jobs/ab12"), store.has("tables/19")) == (entry(5000), True)
    store.delete("jobs/ab12")
    assert store.size_bytes() == on_disk(tmp_path)


def test_quarantine_counts_and_goes_first(tmp_path: Path) -> None:
    """What is damaged takes no more room than the quota has to spare."""
    store = open_store(str(tmp_path), 3 * stored_size(1000))
    for key in ("tables/old", "tables/damaged", "jobs/damaged"):
        store.put(key, entry(1000))
    for key in ("tables/damaged", "jobs/damaged"):
        (tmp_path / key).write_bytes(b"x" * stored_size(1000))
        assert store.get(key) is None
    assert store.size_bytes() == on_disk(tmp_path) == 3 * stored_size(1000)
    store.put("tables/new", entry(1000))
    assert sorted(store.keys()) == ["tables/new", "tables/old"]


def test_files_of_other_people_stay(tmp_path: Path) -> None:
    """Naming a folder in use as the store's, by mistake, loses nothing that is no entry."""
    (tmp_path / "tables").mkdir()
    theirs = {tmp_path / "thesis.txt": b"x" * 3000, tmp_path / "tables" / "data.csv": b"1," * 10}
    for path, content in theirs.items():
        path.write_bytes(content)
    store = open_store(str(tmp_path), 4 * KIBIBYTE)
    for number in range(10):
        store.put(f"tables/{number}", entry(500))
    with pytest.raises(StoreError, match="files that cannot be evicted leave no room"):
        store.put("tables/large", entry(2000))
    assert {path: path.read_bytes() for path in theirs} == theirs
    assert on_disk(tmp_path) <= 4 * KIBIBYTE


def test_counts_what_others_have_copied_in(tmp_path: Path) -> None:
    """A process counts the folder when it first writes, so a ledger that was wrong is right again."""
    open_store(str(tmp_path)).put("tables/0", entry(1000))
    for number in range(1, 9):
        shutil.copy(tmp_path / "tables/0", tmp_path / f"tables/{number}")
    store = open_store(str(tmp_path), 4 * KIBIBYTE)
    store.put("tables/9", entry(1000))
    assert store.size_bytes() == on_disk(tmp_path) <= 4 * KIBIBYTE


def test_a_ledger_that_says_too_much_costs_nothing(tmp_path: Path) -> None:
    """Entries that somebody removed by hand leave room, and none goes for a number."""
    store = open_store(str(tmp_path), 5 * stored_size(1000))
    for number in range(5):
        store.put(f"tables/{number}", entry(1000))
    for number in range(3):
        (tmp_path / f"tables/{number}").unlink()
    store.put("tables/5", entry(1000))
    assert (store.size_bytes(), store.evicted) == (3 * stored_size(1000), 0)


@pytest.mark.parametrize("ledger", [b"", b"nonsense", b"00000000000000000001", b"9" * 40])
def test_takes_no_ledger_on_trust(tmp_path: Path, ledger: bytes) -> None:
    """Whatever a crash has left in the file, the folder itself is what counts."""
    open_store(str(tmp_path)).put("tables/0", entry(1000))
    (tmp_path / ".lock").write_bytes(ledger)
    store = open_store(str(tmp_path), 4 * KIBIBYTE)
    store.put("tables/1", entry(1000))
    assert store.size_bytes() == on_disk(tmp_path) == 2 * stored_size(1000)


@pytest.mark.parametrize("ledger", [b"", b"nonsense"])
def test_a_ledger_lost_meanwhile_is_made_again(tmp_path: Path, ledger: bytes) -> None:
    """Clearing hidden files out of the folder does not lift the quota."""
    store = open_store(str(tmp_path), 4 * KIBIBYTE)
    store.put("tables/0", entry(1000))
    (tmp_path / ".lock").write_bytes(ledger)
    store.put("tables/1", entry(1000))
    assert store.size_bytes() == on_disk(tmp_path) == 2 * stored_size(1000)


LOOKING = """
import sys
from nacreous.store.entry import Entry
from nacreous.store.store import open_store
store, looked = open_store(sys.argv[1], 10**6), []
store.put("tables/0", Entry({}, b"first"))
sys.addaudithook(lambda event, arguments: event == "os.scandir" and looked.append(arguments))
for number in range(100):
    store.put(f"tables/{number}", Entry({}, b"more"))
print(len(looked))
list(store.keys())
print(len(looked) > 0)
"""


def test_a_put_that_finds_room_looks_through_no_folder(tmp_path: Path) -> None:
    """Its cost is that of one file, however many there are; Python's audit events say what is listed."""
    command = [sys.executable, "-c", LOOKING, str(tmp_path)]
    assert subprocess.run(command, check=True, capture_output=True, text=True).stdout.split() == ["0", "True"]
