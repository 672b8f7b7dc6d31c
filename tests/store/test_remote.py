"""A store on a real S3 server on loopback, and what is said where there is none."""

import os
import subprocess
import sys

import fsspec
import pytest

from nacreous.errors import StoreError
from nacreous.store.entry import Entry
from nacreous.store.store import open_store

KEY = "tables/ab/ab12.exr"
ENTRY = Entry({"id": "ab12"}, b"a texture")

ONE_PUT = """
import sys
from nacreous.store.entry import Entry
from nacreous.store.store import open_store
open_store(sys.argv[1]).put(sys.argv[2], Entry({"id": "ab12"}, b"a texture"))
"""


def test_the_environment_says_where_s3_is(bucket: str, s3_endpoint: str) -> None:
    """The variables named in `nacreous.store.remote` are enough for another process, whose entry is seen."""
    store = open_store(bucket)
    store.put("tables/ab/other.exr", ENTRY)
    assert (list(store.keys()), store.has(KEY)) == (["tables/ab/other.exr"], False)
    aws = {
        "AWS_ACCESS_KEY_ID": "nobody",
        "AWS_SECRET_ACCESS_KEY": "nothing",
        "AWS_DEFAULT_REGION": "us-east-1",
    }
    environment = {**os.environ, **aws, "FSSPEC_S3_ENDPOINT_URL": s3_endpoint}
    subprocess.run([sys.executable, "-c", ONE_PUT, bucket, KEY], env=environment, check=True)
    assert (store.has(KEY), store.get(KEY), len(list(store.keys()))) == (True, ENTRY, 2)


def test_stores_of_one_bucket_are_apart(bucket: str) -> None:
    """A prefix is a store of its own."""
    open_store(f"{bucket}/one").put(KEY, ENTRY)
    assert list(open_store(f"{bucket}/one/").keys()) == [KEY]
    assert list(open_store(f"{bucket}/two").keys()) == []
    assert open_store(f"{bucket}/two").get(KEY) is None


@pytest.mark.usefixtures("s3_options")
def test_a_bucket_that_is_not_there() -> None:
    """Nothing is found in it, and nothing can be put."""
    store = open_store("s3://no-such-bucket/films")
    assert (store.get(KEY), store.has(KEY), list(store.keys())) == (None, False, [])
    for write in (store.check_writable, lambda: store.put(KEY, ENTRY)):
        with pytest.raises(StoreError, match="bucket does not exist"):
            write()


def test_a_server_that_is_not_there(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every use of it says so: an entry that cannot be looked for is not said to be absent."""
    nowhere = {"endpoint_url": "http://127.0.0.1:9", "key": "nobody", "secret": "nothing"}
    nowhere["config_kwargs"] = {"retries": {"max_attempts": 0}}
    monkeypatch.setitem(fsspec.config.conf, "s3", nowhere)
    store = open_store("s3://films")
    for use in (store.get, store.has, lambda key: store.put(key, ENTRY), lambda key: list(store.keys(key))):
        with pytest.raises(StoreError, match="Could not connect"):
            use(KEY)
    for use in (store.size_bytes, store.check_writable):
        with pytest.raises(StoreError, match="Could not connect"):
            use()


WITHOUT = """
import sys
sys.modules["s3fs"] = None  # Python's own way of saying that there is no such module
from nacreous.store.store import open_store
open_store("s3://films")
"""


def test_says_what_to_install_for_s3() -> None:
    """Nacreous' extra by its name."""
    done = subprocess.run([sys.executable, "-c", WITHOUT], capture_output=True, text=True)
    assert "StoreError: the store s3://films needs a driver that is not installed" in done.stderr
    assert "pip install 'nacreous[s3]'" in done.stderr


SECRET = "KEY:se/cret"  # noqa: S105 - nobody's


@pytest.mark.usefixtures("s3_options")
def test_a_password_in_the_url_is_in_no_message() -> None:
    """Whatever goes wrong, and whoever says so: /readyz answers it to anybody."""
    store = open_store(f"s3://{SECRET}@films/table")
    for use in (store.get, store.has, lambda key: store.put(key, ENTRY), lambda _: store.check_writable()):
        with pytest.raises(StoreError) as caught:
            use(KEY)
        assert "cret" not in str(caught.value)
    for url, quota_bytes in ((f"s3://{SECRET}@films", 2**20), (f"nothing://{SECRET}@films", None)):
        with pytest.raises(StoreError, match="…@films") as caught:
            open_store(url, quota_bytes)
        assert "cret" not in str(caught.value)
