"""A store keeps its promises at every kind of place."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory

import fsspec
import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

from nacreous.errors import StoreError
from nacreous.store.entry import Entry
from nacreous.store.folder import FolderObjects
from nacreous.store.objects import Objects
from nacreous.store.remote import RemoteObjects
from nacreous.store.store import Store, open_store

KEY = "tables/ab/ab12.exr"
ENTRY = Entry({"id": "ab12", "certificate": {"delta_e": 0.1}}, bytes(range(256)))


def test_gives_back_what_was_put(store: Store) -> None:
    """Facts and bytes, as often as they are asked for."""
    store.put(KEY, ENTRY)
    assert store.get(KEY) == store.get(KEY) == ENTRY


def test_what_is_not_there_is_none(store: Store) -> None:
    """Neither an absent entry nor the folder of one is an error."""
    assert (store.get(KEY), store.has(KEY), list(store.keys()), store.size_bytes()) == (None, False, [], 0)
    store.put(KEY, ENTRY)
    assert (store.get("tables/ab"), store.has("tables/ab")) == (None, False)
    assert (store.get(f"{KEY}/below"), store.has(f"{KEY}/below")) == (None, False)


def test_another_process_sees_it(url: str) -> None:
    """What one store puts or deletes is so for every other one at the same place."""
    here, there = open_store(url), open_store(url)
    assert (there.has(KEY), list(here.keys()), list(there.keys())) == (False, [], [])
    here.put(KEY, ENTRY)
    assert there.get(KEY) == ENTRY
    assert (there.has(KEY), list(there.keys())) == (True, [KEY])
    assert (list(here.keys()), list(here.keys("tables/ab/"))) == ([KEY], [KEY])
    there.delete(KEY)
    assert (here.has(KEY), list(here.keys()), here.get(KEY)) == (False, [], None)


def test_lists_by_prefix(store: Store) -> None:
    """A prefix may end anywhere in a name, not only at a folder."""
    keys = ["tables/ab/ab12.exr", "tables/ab/ab13.exr", "tables/ac/ac00.exr", "jobs/ab12", "film"]
    for key in keys:
        store.put(key, ENTRY)
    for prefix in (
        "",
        "t",
        "tables/",
        "tables/a",
        "tables/ab/",
        "tables/ab/ab12",
        "jobs/",
        "jobs/b",
        "film",
        "none/",
    ):
        assert sorted(store.keys(prefix)) == sorted(key for key in keys if key.startswith(prefix))


@pytest.mark.parametrize("key", ["../escaped", "/etc/passwd", "tables/.hidden", "quarantine/ab"])
def test_no_method_takes_a_name_that_is_no_key(store: Store, key: str) -> None:
    """Whoever composes keys wrongly is told at once, and nothing is touched."""
    for method in (store.get, store.has, store.delete, lambda key: store.put(key, ENTRY)):
        with pytest.raises(ValueError, match="expected a key"):
            method(key)
    with pytest.raises(ValueError, match="beginning of a key"):
        store.keys(key)


def test_a_damaged_entry_is_not_served(store: Store, url: str) -> None:
    """It lies in quarantine then, as it was found, and its place is free for a new one."""
    store.put(KEY, ENTRY)
    with fsspec.open(f"{url}/{KEY}", "wb") as file:
        file.write(b"damaged")
    assert (store.get(KEY), store.quarantined, store.has(KEY), list(store.keys())) == (None, 1, False, [])
    files, root = fsspec.url_to_fs(f"{url}/quarantine")
    files.invalidate_cache()
    assert [files.cat_file(path) for path in files.find(root)] == [b"damaged"]
    store.put(KEY, ENTRY)
    assert (store.get(KEY), store.quarantined) == (ENTRY, 1)


def test_an_entry_under_another_name_is_not_served(store: Store, url: str) -> None:
    """Copying files about in the store by hand does not make one table another."""
    store.put(KEY, ENTRY)
    files, root = fsspec.url_to_fs(url)
    files.copy(f"{root}/{KEY}", f"{root}/tables/ab/other.exr")
    assert (store.get("tables/ab/other.exr"), store.get(KEY), store.quarantined) == (None, ENTRY, 1)


@pytest.mark.parametrize("place", [FolderObjects, lambda folder: RemoteObjects(f"memory://{folder}")])
def test_only_what_was_read_is_set_aside(place: Callable[[Path], Objects], tmp_path: Path) -> None:
    """Where a damaged object has been replaced before it is moved away, the new one stays."""
    objects = place(tmp_path)
    objects.write(KEY, b"new")
    objects.set_aside(KEY, b"damaged")
    assert objects.read(KEY) == b"new"
    objects.set_aside(KEY, b"new")
    assert objects.read(KEY) is None


def test_serves_several_threads(store: Store) -> None:
    """Threads that replace, read, list and delete the same entries see whole ones or none."""

    def use(number: int) -> None:
        key, entry = f"tables/{number % 3}", Entry({"number": number}, bytes([number]) * 1000)
        store.put(key, entry)
        found = store.get(key)
        assert found is None or found.payload == bytes([found.facts["number"]]) * 1000
        assert set(store.keys()) <= {"tables/0", "tables/1", "tables/2"}
        store.delete(key)

    with ThreadPoolExecutor(4) as threads:
        list(threads.map(use, range(40)))
    assert (list(store.keys()), store.size_bytes(), store.quarantined) == ([], 0, 0)


def test_says_that_it_can_be_written(store: Store) -> None:
    """The check leaves nothing behind."""
    store.check_writable()
    assert (list(store.keys()), store.size_bytes()) == ([], 0)


def test_jobs_do_not_count(store: Store) -> None:
    """The size is of what may be evicted."""
    store.put("jobs/ab12", ENTRY)
    assert store.size_bytes() == 0
    store.put(KEY, ENTRY)
    assert store.size_bytes() == len(ENTRY.to_bytes(KEY))


KEYS = st.sampled_from(["film", "tables/ab/1", "tables/ab/2", "tables/cd/1", "jobs/1"])
ENTRIES = st.builds(Entry, st.fixed_dictionaries({"id": st.integers()}), st.binary(max_size=50))


class AnyPlace(RuleBasedStateMachine):
    """A store is a dictionary, whatever is done with it in whatever order."""

    def __init__(self) -> None:
        super().__init__()
        self.model: dict[str, Entry] = {}

    @rule(key=KEYS, entry=ENTRIES)
    def put(self, key: str, entry: Entry) -> None:
        """Keep, or replace."""
        self.store.put(key, entry)
        self.model[key] = entry

    @rule(key=KEYS)
    def delete(self, key: str) -> None:
        """Remove, also what is not there."""
        self.store.delete(key)
        self.model.pop(key, None)

    @rule(key=KEYS)
    def get(self, key: str) -> None:
        """Find the entry, or None."""
        assert self.store.get(key) == self.model.get(key)

    @rule(key=KEYS)
    def has(self, key: str) -> None:
        """Know what `get` would find."""
        assert self.store.has(key) == (key in self.model)

    @invariant()
    def lists_what_is_there(self) -> None:
        """Keys and size are those of the dictionary."""
        assert sorted(self.store.keys()) == sorted(self.model)
        sizes = (len(entry.to_bytes(key)) for key, entry in self.model.items() if not key.startswith("jobs/"))
        assert self.store.size_bytes() == sum(sizes)


class InFolder(AnyPlace):
    """In a folder."""

    @initialize()
    def make(self) -> None:
        """Begin with none."""
        self.folder = TemporaryDirectory()
        self.store = open_store(f"{self.folder.name}/store")

    @rule()
    def reopen(self) -> None:
        """Another process goes on with what is there."""
        self.store = open_store(f"{self.folder.name}/store")

    def teardown(self) -> None:
        """Nothing is left but entries and the ledger."""
        files = [
            path for path in Path(self.folder.name).rglob("*") if path.is_file() and path.name != ".lock"
        ]
        assert len(files) == len(self.model)
        self.folder.cleanup()


class InMemory(AnyPlace):
    """In fsspec's memory, where an object's PUT is a dictionary's own."""

    @initialize()
    def make(self) -> None:
        """Begin with nothing."""
        files = fsspec.filesystem("memory")
        if files.exists("/laws"):
            files.rm("/laws", recursive=True)
        self.store = open_store("memory://laws")


for machine in (InFolder, InMemory):
    machine.TestCase.settings = settings(max_examples=20, stateful_step_count=15, deadline=None)
TestInFolder, TestInMemory = InFolder.TestCase, InMemory.TestCase


def test_refuses_a_quota_for_what_is_no_folder() -> None:
    """A limit that nobody keeps must not be promised."""
    with pytest.raises(StoreError, match="expected no quota for memory://films"):
        open_store("memory://films", quota_bytes=1)


def test_refuses_a_url_that_nobody_knows() -> None:
    """With the URL, and what is wrong with it."""
    with pytest.raises(StoreError, match="films://ab: Protocol not known: films"):
        open_store("films://ab")


def test_refuses_no_place_at_all() -> None:
    """A variable of the environment that is empty must not mean the current folder."""
    with pytest.raises(StoreError, match="got an empty name"):
        open_store("")


@pytest.mark.parametrize("prefix", ["", "file://", "local://"])
def test_takes_a_folder_by_path_or_url(prefix: str, tmp_path: Path) -> None:
    """All name the same folder, and have a quota."""
    open_store(f"{prefix}{tmp_path}/films", quota_bytes=1000).put("film", ENTRY)
    assert (tmp_path / "films" / "film").is_file()
