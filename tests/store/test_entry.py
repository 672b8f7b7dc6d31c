"""An entry is read back as it was written, or not at all."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nacreous.errors import StoreError
from nacreous.store.entry import Entry

KEY = "tables/ab/ab12.exr"
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
    lambda values: st.lists(values, max_size=3) | st.dictionaries(st.text(), values, max_size=3),
    max_leaves=8,
)
ENTRIES = st.builds(Entry, st.dictionaries(st.text(), JSON, max_size=4), st.binary(max_size=200))


@settings(deadline=None)
@given(ENTRIES)
def test_reads_what_was_written(entry: Entry) -> None:
    """Whatever JSON and whatever bytes: both come back."""
    assert Entry.from_bytes(entry.to_bytes(KEY), KEY) == entry


@settings(deadline=None)
@given(ENTRIES, st.data())
def test_shows_every_changed_bit(entry: Entry, data: st.DataObject) -> None:
    """No bit of the object is without meaning, the line ends between its parts included."""
    stored = bytearray(entry.to_bytes(KEY))
    bit = data.draw(st.integers(0, 8 * len(stored) - 1))
    stored[bit // 8] ^= 1 << bit % 8
    with pytest.raises(StoreError, match="damaged"):
        Entry.from_bytes(bytes(stored), KEY)


@settings(deadline=None)
@given(ENTRIES, st.data())
def test_shows_every_cut(entry: Entry, data: st.DataObject) -> None:
    """A part of an object is no entry, wherever it ends."""
    stored = entry.to_bytes(KEY)
    with pytest.raises(StoreError, match="damaged"):
        Entry.from_bytes(stored[: data.draw(st.integers(0, len(stored) - 1))], KEY)


@settings(deadline=None)
@given(ENTRIES, st.binary(min_size=1))
def test_shows_what_has_been_added(entry: Entry, more: bytes) -> None:
    """Nor is an object with anything behind it."""
    with pytest.raises(StoreError, match="damaged"):
        Entry.from_bytes(entry.to_bytes(KEY) + more, KEY)


@settings(deadline=None)
@given(ENTRIES)
def test_is_of_one_key(entry: Entry) -> None:
    """A sound object under another entry's name is not that entry."""
    with pytest.raises(StoreError, match="damaged"):
        Entry.from_bytes(entry.to_bytes("tables/cd/cd34.exr"), KEY)


def test_checksum_is_sha_256() -> None:
    """FIPS 180-4's example for the message "abc"."""
    expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
    assert Entry({}, b"abc").sha256 == expected
