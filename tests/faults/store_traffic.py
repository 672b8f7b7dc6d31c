"""What other processes do to a store: they put entries into it, and get them out of it."""

from collections.abc import Iterator
from dataclasses import dataclass
from multiprocessing.connection import Connection
from multiprocessing.synchronize import Event

import numpy as np

from nacreous.store.entry import Entry
from nacreous.store.store import Store, open_store

__all__ = ["KEYS", "Readings", "is_whole", "put_for_ever", "put_until", "read"]

KEYS = tuple(f"tables/{number % 7:02x}/{number:04x}.exr" for number in range(200))


def put_until(folder: str, quota: int, largest: int, seed: int, done: Event) -> int:
    """Put random entries of up to `largest` bytes until it is enough; return how many were put."""
    store, count = open_store(folder, quota), 0
    entries = _entries(seed, largest)
    while not done.is_set():
        store.put(*next(entries))
        count += 1
    return count


def put_for_ever(folder: str, quota: int, largest: int, seed: int, putting: Connection) -> None:
    """Put random entries, and say so each time."""
    store = open_store(folder, quota)
    for key, entry in _entries(seed, largest):
        store.put(key, entry)
        putting.send(key)


def _entries(seed: int, largest: int) -> Iterator[tuple[str, Entry]]:
    """Yield entries that say themselves what their bytes must be."""
    random = np.random.default_rng(seed)
    while True:
        key, length, number = random.choice(KEYS), int(random.integers(largest)), int(random.integers(2**40))
        facts = {"key": str(key), "length": length, "number": number}
        yield str(key), Entry(facts, _content(facts))


def _content(facts: dict[str, int | str]) -> bytes:
    word = f"{facts['number']} of {facts['key']};".encode()
    return (word * (facts["length"] // len(word) + 1))[: facts["length"]]


def is_whole(key: str, entry: Entry) -> bool:
    """Return whether an entry is one that has been put under its key, with all of its bytes."""
    return entry.facts["key"] == key and entry.payload == _content(dict(entry.facts))


@dataclass(frozen=True)
class Readings:
    """What came of reading: how many entries were whole, torn, found damaged by the store, or not there."""

    whole: int
    torn: int
    quarantined: int
    absent: int


def read(folder: str, count: int, seed: int) -> Readings:
    """Get random entries."""
    store, outcomes = open_store(folder), {True: 0, False: 0, None: 0}
    for key in np.random.default_rng(seed).choice(KEYS, size=count):
        outcomes[_outcome(store, str(key))] += 1
    return Readings(outcomes[True], outcomes[False], store.quarantined, outcomes[None] - store.quarantined)


def _outcome(store: Store, key: str) -> bool | None:
    entry = store.get(key)
    return None if entry is None else is_whole(key, entry)
