"""No key names anything outside the store, or anything hidden in it."""

import os

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nacreous.store.keys import check_key, check_prefix, is_key

PATHS = st.lists(st.text("ab.-_/\\\0 é\n~", max_size=4), max_size=6).map("/".join)


@pytest.mark.parametrize(
    "key",
    [
        "film",
        "tables/ab/ab12.transmission.exr",
        "tables/ab/ab12.Soap-bubble_2.mtlx",
        "jobs/ab12",
        "quarantined/a",
    ],
)
def test_takes_the_names_of_files(key: str) -> None:
    """Ids, suffixes of several parts and stems of presets are all fit for a key."""
    check_key(key)


WAYS_OUT = ("", "/", "/etc/passwd", "..", "../a", "a/..", "a/../b", "a/./b", "a//b", "a/", "~")
HIDDEN = (".a", "a/.lock", "quarantine", "quarantine/a")
NOT_PLAIN = ("a\0", "a\n", "a b", "a\\b", "é", "٣", "a:b")
TOO_LONG = ("a" * 256, "a/" * 512 + "a")


@pytest.mark.parametrize("key", [*WAYS_OUT, *HIDDEN, *NOT_PLAIN, *TOO_LONG])
def test_refuses_every_other_name(key: str) -> None:
    """Ways out, hidden names, what is no plain letter, and what a file system or S3 would not take."""
    with pytest.raises(ValueError, match="expected a key"):
        check_key(key)


@settings(deadline=None)
@given(PATHS)
def test_stays_below_the_root(key: str) -> None:
    """Resolving a key's dots and slashes changes nothing: it was a plain path downwards."""
    if is_key(key):
        assert os.path.normpath(os.path.join("/store", key)) == f"/store/{key}"  # noqa: PTH118 - lexical, as is meant
        assert "/." not in f"/{key}"


@pytest.mark.parametrize("prefix", ["../", "a/../", "/", "a//", ".a", "a/.", "quarantine/"])
def test_refuses_prefixes_that_no_key_has(prefix: str) -> None:
    """Listing leads out of the store as little as reading does."""
    with pytest.raises(ValueError, match="beginning of a key"):
        check_prefix(prefix)


@settings(deadline=None)
@given(st.from_regex(r"[a-z]{1,3}(/[a-z.]{1,3}){0,3}", fullmatch=True).filter(is_key), st.data())
def test_takes_every_prefix_of_a_key(key: str, data: st.DataObject) -> None:
    """What a key begins with may be asked for."""
    check_prefix(key[: data.draw(st.integers(0, len(key)))])
