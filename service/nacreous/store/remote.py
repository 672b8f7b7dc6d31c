"""Objects on anything that fsspec reaches, such as a bucket on S3, which many machines may share.

An object is written with one PUT, and object stores show it as a whole or not at all (Amazon S3 user guide,
data consistency model). How much they hold and what they remove is a matter of their own rules, so there is
no quota here.

Options that are not in the URL come from the environment: fsspec takes ``FSSPEC_S3_ENDPOINT_URL`` as the
option ``endpoint_url`` of S3 (fsspec documentation, configuration), and S3's driver takes
``AWS_ACCESS_KEY_ID``, ``AWS_SECRET_ACCESS_KEY``, ``AWS_DEFAULT_REGION`` and the files of the AWS command
line.
"""

import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, cast

import fsspec  # type: ignore[import-untyped] # it ships no types

from nacreous.errors import StoreError, without_user_info
from nacreous.store.keys import QUARANTINE, is_key
from nacreous.store.quota import counted_bytes

if TYPE_CHECKING:
    from fsspec.spec import AbstractFileSystem  # type: ignore[import-untyped] # it ships no types

__all__ = ["RemoteObjects"]

_EXTRAS = {"s3": "s3", "s3a": "s3"}
"""Nacreous' own extras, by protocol."""


class RemoteObjects:
    """Objects below a URL.

    Parameters
    ----------
    url : str
        Such as ``s3://bucket/prefix`` or ``memory://name``; the bucket must exist.

    Raises
    ------
    StoreError
        There is no such protocol, or its driver is not installed.
    """

    evicted = 0
    """Nothing is ever evicted."""

    def __init__(self, url: str) -> None:
        self._url = url
        self._files, self._root = _opened(url)

    def read(self, key: str) -> bytes | None:
        """Return an object; None where there is none."""
        with self._explained(f"{key} cannot be read from the store"), suppress(FileNotFoundError):
            return cast("bytes", self._files.cat_file(self._path(key)))
        return None

    def write(self, key: str, stored: bytes) -> None:
        """Put an object in place of what is there, in one step."""
        with self._explained(f"{key} cannot be kept in the store"):
            self._files.pipe_file(self._path(key), stored)

    def set_aside(self, key: str, damaged: bytes) -> None:
        """Move an object to the quarantine, unless it has been replaced by another one than `damaged`."""
        name = key.rpartition("/")[2]
        if self.read(key) == damaged:
            self.write(f"{QUARANTINE}/{secrets.token_hex(8)}-{name[-200:]}", damaged)
            self.delete(key)

    def delete(self, key: str) -> None:
        """Remove an object, where there is one."""
        with self._explained(f"{key} cannot be removed from the store"), suppress(FileNotFoundError):
            self._files.rm_file(self._path(key))

    def has(self, key: str) -> bool:
        """Return whether there is such an object, without reading it."""
        with self._explained(f"{key} cannot be looked for in the store"), suppress(FileNotFoundError):
            self._files.invalidate_cache()  # of listings, which other machines have changed since
            return bool(self._files.info(self._path(key))["type"] == "file")
        return False

    def keys(self, prefix: str) -> Iterator[str]:
        """Yield the names that begin with `prefix`, in any order."""
        for key in self._sizes(prefix.rpartition("/")[0]):
            if key.startswith(prefix) and is_key(key):
                yield key

    def check_writable(self) -> None:
        """Write a hidden object and remove it again."""
        probe = f".nacreous-{secrets.token_hex(8)}.part"
        with self._explained(f"the store {self._root} cannot be written"):
            self._files.pipe_file(self._path(probe), b"probe")
            self._files.rm_file(self._path(probe))

    def size_bytes(self) -> int:
        """Return what the objects take without jobs; lists all of them."""
        return sum(counted_bytes(key.split("/")[:-1], size) for key, size in self._sizes("").items())

    def _sizes(self, folder: str) -> dict[str, int]:
        """Return the size in bytes of each object below a folder."""
        with self._explained("the store cannot be listed"), suppress(FileNotFoundError):
            self._files.invalidate_cache()
            found = self._files.find(self._path(folder).rstrip("/"), detail=True).items()
            # S3's driver lists a prefix itself where its first object comes while it is being listed.
            sizes = {name: int(about["size"]) for name, about in found if about["type"] == "file"}
            return {name.removeprefix(self._path("")): size for name, size in sizes.items()}
        return {}

    def _path(self, key: str) -> str:
        return f"{self._root}/{key}"

    @contextmanager
    def _explained(self, failure: str) -> Iterator[None]:
        """Say what has failed where a driver says only why, and not with which password."""
        try:
            yield
        except Exception as error:  # every driver has errors of its own
            raise StoreError(without_user_info(self._url, f"{failure}: {error}")) from error


def _opened(url: str) -> "tuple[AbstractFileSystem, str]":
    try:
        files, root = fsspec.url_to_fs(url)
    except ImportError as error:
        extra = _EXTRAS.get(url.partition("://")[0])
        hint = f": pip install 'nacreous[{extra}]'" if extra else ""
        fault = f"the store {url} needs a driver that is not installed: {error}{hint}"
        raise StoreError(without_user_info(url, fault)) from error
    except ValueError as error:
        fault = f"expected a folder or a URL that fsspec knows for the store, got {url}: {error}"
        raise StoreError(without_user_info(url, fault)) from error
    return files, root.rstrip("/")
