"""Files in memory: bounded by bytes, the least recently used go first."""

from hypothesis import given
from hypothesis import strategies as st

from nacreous.engine.hot import Hot
from nacreous.store.entry import Entry

MIB = 2**20


def file_of(size: int) -> Entry:
    """Return a file of so many bytes."""
    return Entry({}, bytes(size))


@given(st.lists(st.tuples(st.sampled_from("abcdef"), st.integers(0, 3 * MIB // 2)), max_size=30))
def test_the_limit_holds_whatever_is_put(puts: list[tuple[str, int]]) -> None:
    """Payloads kept at a time are never more than the limit, replaced ones included."""
    hot, last = Hot(MIB), dict[str, Entry]()
    for key, size in puts:
        last[key] = file_of(size)
        hot.put(key, last[key])
        kept = {name: entry for name in last if (entry := hot.get(name)) is not None}
        assert sum(len(entry.payload) for entry in kept.values()) <= hot.size_bytes <= MIB
        assert all(entry is last[name] for name, entry in kept.items())


def test_the_least_recently_used_goes_first() -> None:
    """A file that was asked for stays, and one that was not makes room."""
    hot = Hot(MIB)
    for key in ("old", "used"):
        hot.put(key, file_of(MIB // 3))
    hot.get("old")
    hot.get("used")
    hot.get("old")
    hot.put("new", file_of(MIB // 2))
    assert hot.get("used") is None
    assert hot.get("old") is not None


def test_what_is_larger_than_the_limit_displaces_nothing() -> None:
    """A file that cannot be kept is no reason to forget the others."""
    hot = Hot(MIB)
    hot.put("small", file_of(10))
    hot.put("large", file_of(2 * MIB))
    assert hot.get("large") is None
    assert hot.get("small") is not None
