"""Messages are for people: sizes in a unit that has digits, failures without a number of the system."""

import errno
import os
from collections.abc import Callable

import nacreous_client.errors
import pytest

from nacreous.errors import BudgetError, reason, without_user_info


@pytest.mark.parametrize(
    ("limit_bytes", "expected"), [(1000, "1000 bytes"), (3072, "3.0 KiB"), (5 * 2**20, "5.0 MiB")]
)
def test_a_small_budget_is_not_shown_as_nothing(limit_bytes: int, expected: str) -> None:
    """1 KiB is 1,024 bytes (IEC 80000-13)."""
    assert f"the limit is {expected};" in str(BudgetError("a table", 10**9, limit_bytes))


def test_a_reason_is_words() -> None:
    """POSIX's strerror where there is one, else the text of the error."""
    assert reason(OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "film.exr")) == "No space left on device"
    assert reason(ValueError("embedded null byte")) == "embedded null byte"


ADDRESSES = {
    "http://anna:pass@host:8000/path": "http://…@host:8000/path",
    "http://anna@host": "http://…@host",
    "s3://KEY:se/cr/et@bucket/films": "s3://…@bucket/films",
    "sftp://anna:p@ss@host/films": "sftp://…@host/films",
    "http://host:8000/a@b": "http://host:8000/a@b",
    "s3://bucket/films@home": "s3://bucket/films@home",
    "/home/anna@work/films": "/home/anna@work/films",
}
"""Addresses, some with user information (RFC 3986, section 3.2.1), some with an @ of another kind."""


@pytest.mark.parametrize(("address", "shown"), ADDRESSES.items())
@pytest.mark.parametrize("mask", [without_user_info, nacreous_client.errors.without_user_info])
def test_a_password_in_an_address_is_not_shown(mask: Callable[[str], str], address: str, shown: str) -> None:
    """The service and its client, which shares no code with it, hide the same."""
    assert mask(address) == shown


def test_a_password_is_taken_out_of_what_others_say() -> None:
    """A driver may tell it by another address than the one that it was given."""
    said = 'Invalid bucket name "KEY:secret@bucket"'
    assert without_user_info("s3://KEY:secret@bucket/a", said) == 'Invalid bucket name "…@bucket"'
    assert without_user_info("s3://bucket/a", said) == said
