"""A folder holds entries and nothing else: no link leads out, and what cannot be done is said."""

import os
import socket
from pathlib import Path

import pytest

from nacreous.errors import StoreError
from nacreous.store.entry import Entry
from nacreous.store.store import open_store
from small_disk import mounted, remounted_read_only

KEY = "tables/ab/ab12.exr"
ENTRY = Entry({"id": "ab12"}, b"a texture")


@pytest.fixture
def elsewhere(tmp_path: Path) -> Path:
    """Return a folder outside the store that has what looks like the store's entry."""
    folder = tmp_path / "elsewhere"
    open_store(str(folder)).put(KEY, ENTRY)
    return folder


@pytest.mark.parametrize("link", [KEY, "tables/ab", "tables"])
def test_no_link_is_followed(tmp_path: Path, elsewhere: Path, link: str) -> None:
    """Neither the entry nor any folder on the way to it may be a symbolic link."""
    store, inside = open_store(str(tmp_path / "store")), tmp_path / "store" / link
    inside.parent.mkdir(parents=True)
    inside.symlink_to(elsewhere / link)
    assert (store.get(KEY), store.has(KEY), list(store.keys()), list(store.keys("tables/"))) == (
        None,
        False,
        [],
        [],
    )
    store.delete(KEY)
    assert open_store(str(elsewhere)).get(KEY) == ENTRY
    assert store.size_bytes() == 0


def test_an_entry_takes_the_place_of_a_link(tmp_path: Path, elsewhere: Path) -> None:
    """Putting replaces the link itself, and writes nothing through it."""
    store, inside = open_store(str(tmp_path / "store")), tmp_path / "store" / KEY
    inside.parent.mkdir(parents=True)
    inside.symlink_to(elsewhere / KEY)
    store.put(KEY, Entry({}, b"new"))
    assert not inside.is_symlink()
    assert (store.get(KEY), open_store(str(elsewhere)).get(KEY)) == (Entry({}, b"new"), ENTRY)


@pytest.mark.parametrize("link", ["tables/ab", "tables"])
def test_nothing_is_put_through_a_link(tmp_path: Path, elsewhere: Path, link: str) -> None:
    """A folder of the store that is a link is refused, and nothing appears where it leads."""
    store, inside = open_store(str(tmp_path / "store")), tmp_path / "store" / link
    inside.parent.mkdir(parents=True)
    inside.symlink_to(elsewhere / link)
    with pytest.raises(StoreError, match="Not a directory"):
        store.put("tables/ab/new.exr", ENTRY)
    assert [path.name for path in elsewhere.rglob("*") if path.is_file()] == [".lock", "ab12.exr"]


def test_the_ledger_is_no_link(tmp_path: Path) -> None:
    """Its number is written into no other file."""
    (tmp_path / "victim").write_text("as it was")
    (tmp_path / "store").mkdir()
    (tmp_path / "store" / ".lock").symlink_to(tmp_path / "victim")
    with pytest.raises(StoreError, match="symbolic link"):
        open_store(str(tmp_path / "store")).put(KEY, ENTRY)
    assert (tmp_path / "victim").read_text() == "as it was"


def test_the_store_itself_may_be_a_link(tmp_path: Path) -> None:
    """Whoever runs the service chooses where its store lies."""
    (tmp_path / "disk").mkdir()
    (tmp_path / "store").symlink_to(tmp_path / "disk")
    store = open_store(str(tmp_path / "store"), 1000)
    store.put(KEY, ENTRY)
    assert (store.get(KEY), list(store.keys()), store.has(KEY)) == (ENTRY, [KEY], True)
    assert (tmp_path / "disk" / KEY).is_file()


def test_a_pipe_or_a_socket_is_no_entry(tmp_path: Path) -> None:
    """Reading one would wait for its writer for ever."""
    (tmp_path / "tables").mkdir()
    os.mkfifo(tmp_path / "tables" / "pipe")
    store = open_store(str(tmp_path))
    with socket.socket(socket.AF_UNIX) as unix:
        unix.bind(str(tmp_path / "tables" / "socket"))
        for key in ("tables/pipe", "tables/socket"):
            assert (store.get(key), store.has(key), list(store.keys())) == (None, False, [])


def test_a_reader_keeps_what_it_has_opened(tmp_path: Path) -> None:
    """Replacing gives a name another file (POSIX.1-2017, rename): who has the old one open sees that."""
    store = open_store(str(tmp_path))
    store.put(KEY, ENTRY)
    with (tmp_path / KEY).open("rb") as opened:
        store.put(KEY, Entry({}, b"new"))
        store.delete(KEY)
        assert opened.read() == ENTRY.to_bytes(KEY)


def test_a_file_where_a_folder_should_be(tmp_path: Path) -> None:
    """The store cannot be there, and says why; nothing can be found in it."""
    (tmp_path / "file").touch()
    store = open_store(str(tmp_path / "file" / "store"))
    assert (store.get(KEY), list(store.keys()), store.size_bytes()) == (None, [], 0)
    for write in (store.check_writable, lambda: store.put(KEY, ENTRY)):
        with pytest.raises(StoreError, match="Not a directory"):
            write()


def test_a_folder_where_an_entry_should_be(tmp_path: Path) -> None:
    """It is not replaced, and what had been written is gone again."""
    store = open_store(str(tmp_path), 1000)
    (tmp_path / KEY / "below").mkdir(parents=True)
    with pytest.raises(StoreError, match=r"ab12\.exr cannot be kept in the store: Is a directory"):
        store.put(KEY, ENTRY)
    assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == [".lock"]
    assert store.size_bytes() == 0


def test_a_disk_that_may_only_be_read(tmp_path: Path) -> None:
    """Entries are served, none is put, and a damaged one is neither served nor moved."""
    with mounted(tmp_path / "disk", 2**20) as disk:
        store = open_store(str(disk))
        store.put(KEY, ENTRY)
        store.put("tables/damaged", ENTRY)
        (disk / "tables" / "damaged").write_bytes(b"damaged")
        remounted_read_only(disk)
        assert (store.get(KEY), store.get("tables/damaged"), store.quarantined) == (ENTRY, None, 1)
        for write in (store.check_writable, lambda: store.put(KEY, ENTRY), lambda: store.delete(KEY)):
            with pytest.raises(StoreError, match="Read-only file system"):
                write()
        assert store.get(KEY) == ENTRY
