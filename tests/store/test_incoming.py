"""A file on its way into the store is swept when its writer has ended, and not before."""

from pathlib import Path

from nacreous.store.entry import Entry
from nacreous.store.incoming import IncomingFile
from nacreous.store.nofollow import opened_folder
from nacreous.store.store import open_store

ENTRY = Entry({}, b"another")
HIDDEN = ".nacreous-0123456789abcdef.part"


def test_what_is_under_way_is_not_swept(tmp_path: Path) -> None:
    """However slow its writer is, and however much others count and evict meanwhile; its full size counts."""
    with opened_folder(tmp_path, ()) as folder, IncomingFile(folder, 1000) as file:
        store = open_store(str(tmp_path), 2000)
        for number in range(30):
            store.put(f"tables/{number}", ENTRY)
        assert store.evicted > 0
        assert store.size_bytes() == 1000 + len(list(store.keys())) * len(ENTRY.to_bytes("tables/0"))
        file.fill(b"content")
        file.put_in_place("film")
    assert (tmp_path / "film").read_bytes() == b"content" + bytes(993)
    assert [path.name for path in tmp_path.rglob("*.part")] == []


def test_what_has_been_abandoned_is_swept(tmp_path: Path) -> None:
    """Nobody has its lock any more: the next process that writes to the store removes it."""
    for folder in (tmp_path, tmp_path / "tables", tmp_path / "jobs"):
        folder.mkdir(exist_ok=True)
        (folder / HIDDEN).write_bytes(bytes(1000))
    store = open_store(str(tmp_path))
    store.put("tables/0", ENTRY)
    assert [path.name for path in tmp_path.rglob("*.part")] == []
    assert store.size_bytes() == len(ENTRY.to_bytes("tables/0"))


def test_what_is_not_put_in_place_is_removed(tmp_path: Path) -> None:
    """Closing leaves nothing of it."""
    with opened_folder(tmp_path, ()) as folder, IncomingFile(folder, 1000):
        assert len(list(tmp_path.iterdir())) == 1
    assert list(tmp_path.iterdir()) == []


def test_another_program_s_hidden_files_are_left(tmp_path: Path) -> None:
    """Only names of the store's own are swept, and other hidden files are no entries."""
    (tmp_path / ".nfs0001").write_bytes(bytes(1000))
    store = open_store(str(tmp_path), 1000)
    for number in range(30):
        store.put(f"tables/{number}", ENTRY)
    assert (tmp_path / ".nfs0001").is_file()
