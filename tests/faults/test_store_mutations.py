"""Entries that have been damaged on the disk are never served, whatever has been done to them."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from faults.soak import scale
from nacreous.store.entry import Entry
from nacreous.store.store import open_store

COUNT = scale(100, 1000)
Damage = Callable[[bytes, np.random.Generator], bytes]


def flipped(stored: bytes, random: np.random.Generator) -> bytes:
    """Return the object with one bit changed."""
    bit = int(random.integers(8 * len(stored)))
    damaged = bytearray(stored)
    damaged[bit // 8] ^= 1 << bit % 8
    return bytes(damaged)


def cut(stored: bytes, random: np.random.Generator) -> bytes:
    """Return the beginning of the object, maybe nothing."""
    return stored[: random.integers(len(stored))]


def lengthened(stored: bytes, random: np.random.Generator) -> bytes:
    """Return the object with something behind it."""
    return stored + random.bytes(random.integers(1, 1000))


def zeroed(stored: bytes, random: np.random.Generator) -> bytes:
    """Return the object with a block that never reached the disk."""
    begin = int(random.integers(len(stored) - 512))
    return stored[:begin] + bytes(512) + stored[begin + 512 :]


def garbled(stored: bytes, random: np.random.Generator) -> bytes:
    """Return something else of the same length."""
    return random.bytes(len(stored))


def of_another_key(stored: bytes, random: np.random.Generator) -> bytes:
    """Return a sound object that belongs elsewhere."""
    return Entry({}, stored[: random.integers(len(stored))]).to_bytes("tables/elsewhere")


def forged(stored: bytes, random: np.random.Generator) -> bytes:
    """Return the object with other bytes of the file under the old checksum."""
    return stored[:-64] + random.bytes(64)


DAMAGES: tuple[Damage, ...] = (flipped, cut, lengthened, zeroed, garbled, of_another_key, forged)


def test_no_mutation_is_served(tmp_path: Path) -> None:
    """Each is found when it is read, and kept aside as it was; what is put in its place then is served."""
    store, random = open_store(str(tmp_path)), np.random.default_rng(4)
    entries = {
        f"tables/{number:04x}": Entry({"number": number}, random.bytes(2000)) for number in range(COUNT)
    }
    mutations = []
    for number, (key, entry) in enumerate(entries.items()):
        store.put(key, entry)
        mutations.append(DAMAGES[number % len(DAMAGES)]((tmp_path / key).read_bytes(), random))
        (tmp_path / key).write_bytes(mutations[-1])
    store.put("tables/sound", Entry({}, b"sound"))
    assert [key for key in entries if store.get(key) is not None] == []
    assert store.quarantined == COUNT
    assert sorted(path.read_bytes() for path in (tmp_path / "quarantine").iterdir()) == sorted(mutations)
    assert list(store.keys()) == ["tables/sound"]
    for key, entry in entries.items():
        store.put(key, entry)
    assert all(store.get(key) == entry for key, entry in entries.items())
    assert store.quarantined == COUNT
