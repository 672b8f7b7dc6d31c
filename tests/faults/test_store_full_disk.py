"""On a full disk of 64 MB what is stored is served, and what cannot be stored is not there by half."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from nacreous.errors import StoreError
from nacreous.store.entry import Entry
from nacreous.store.store import Store, open_store
from small_disk import filled, mounted

SIZE = 64 * 2**20
TABLE = 300_000
"""Bytes of a usual lookup texture."""


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Path]:
    """Return a real disk of 64 MB with nothing on it."""
    with mounted(tmp_path / "disk", SIZE) as folder:
        yield folder


def entry(number: int) -> Entry:
    """Return one of many different tables."""
    return Entry({"number": number}, number.to_bytes(4, "big") * (TABLE // 4))


def put_until_full(store: Store) -> tuple[list[str], str]:
    """Put tables until one fails; return the keys that are there now, and why the last is not."""
    keys: list[str] = []
    try:
        while True:
            key = f"tables/{len(keys) % 7}/{len(keys)}"
            store.put(key, entry(len(keys)))
            keys.append(key)
    except StoreError as failure:
        return keys, str(failure)


def files_on(disk: Path) -> int:
    """Return the number of all files, hidden ones as well."""
    return sum(path.is_file() for path in disk.rglob("*"))


def test_what_is_stored_is_served_from_a_full_disk(disk: Path) -> None:
    """Hits as ever; puts say that there is no space, as often as they are tried, and leave nothing."""
    store = open_store(str(disk))
    keys, failure = put_until_full(store)
    assert "No space left on device" in failure
    assert len(keys) > SIZE // TABLE - 10
    for _ in range(3):
        with pytest.raises(StoreError, match="No space left on device"):
            store.put("tables/0/more", entry(0))
    assert all(store.get(key) == entry(number) for number, key in enumerate(keys))
    assert sorted(store.keys()) == sorted(keys)
    assert files_on(disk) == len(keys) + 1  # and the ledger
    assert store.quarantined == 0
    assert store.size_bytes() == sum(len(entry(number).to_bytes(key)) for number, key in enumerate(keys))


def test_an_entry_that_cannot_be_replaced_stays(disk: Path) -> None:
    """The old one is served while there is no room for the new one."""
    store = open_store(str(disk))
    store.put("tables/0", entry(0))
    filled(disk)
    with pytest.raises(StoreError, match="No space left on device"):
        store.put("tables/0", entry(1))
    with pytest.raises(StoreError, match="No space left on device"):
        store.check_writable()
    assert store.get("tables/0") == entry(0)


def test_goes_on_when_there_is_room_again(disk: Path) -> None:
    """Removing an entry needs no room, and a store that has failed needs no new process."""
    store = open_store(str(disk))
    store.put("tables/0", entry(0))
    filling = filled(disk)
    with pytest.raises(StoreError):
        store.put("tables/1", entry(1))
    store.delete("tables/0")
    store.put("tables/1", entry(1))
    filling.unlink()
    store.check_writable()
    assert store.get("tables/1") == entry(1)


def test_a_store_begun_on_a_full_disk(disk: Path) -> None:
    """It has nothing, and can begin when there is room."""
    filling = filled(disk)
    store = open_store(str(disk / "store"))
    with pytest.raises(StoreError, match="No space left on device"):
        store.put("tables/0", entry(0))
    assert (store.get("tables/0"), list(store.keys())) == (None, [])
    filling.unlink()
    store.put("tables/0", entry(0))
    assert store.get("tables/0") == entry(0)


def test_a_quota_keeps_a_disk_from_being_full(disk: Path) -> None:
    """Whatever is put: with a quota below the disk's size each put finds room."""
    store = open_store(str(disk), SIZE // 2)
    for number in range(2 * SIZE // TABLE):
        store.put(f"tables/{number}", entry(number))
    assert store.evicted > 0
    assert store.size_bytes() <= SIZE // 2
