"""The store: entries by key, whatever place their objects lie in."""

from collections.abc import Iterator
from pathlib import Path
from threading import Lock

from fsspec.core import split_protocol  # type: ignore[import-untyped] # it ships no types

from nacreous.errors import StoreError, without_user_info
from nacreous.store.entry import Entry
from nacreous.store.folder import FolderObjects
from nacreous.store.keys import check_key, check_prefix
from nacreous.store.objects import Objects
from nacreous.store.remote import RemoteObjects

__all__ = ["Store", "is_folder", "open_store"]

_LOCAL = (None, "file", "local")
"""What a URL of a local folder begins with."""


class Store:
    """Finished files, to be used from several threads, and beside other processes on the same place.

    Keys are parts of letters, digits and ``-_.`` with ``/`` between them, none beginning with a dot, such as
    ``tables/ab/ab12.exr``; any other is a `ValueError`. Entries below ``jobs/`` neither count for the quota
    nor are evicted.

    Parameters
    ----------
    objects : Objects
    """

    def __init__(self, objects: Objects) -> None:
        self._objects, self._lock, self._quarantined = objects, Lock(), 0

    @property
    def quarantined(self) -> int:
        """How many damaged entries have been met."""
        return self._quarantined

    @property
    def evicted(self) -> int:
        """How many entries this process has removed to make room."""
        return self._objects.evicted

    def get(self, key: str) -> Entry | None:
        """Return an entry as it was put, and remember that it has been used.

        A damaged one is moved to ``quarantine/``, counted, and as if it were not there.

        Raises
        ------
        StoreError
            The store cannot be read.
        """
        check_key(key)
        stored = self._objects.read(key)
        if stored is None:
            return None
        try:
            return Entry.from_bytes(stored, key)
        except StoreError:
            self._set_aside(key, stored)
            return None

    def _set_aside(self, key: str, damaged: bytes) -> None:
        with self._lock:
            self._quarantined += 1
        try:
            self._objects.set_aside(key, damaged)
        except StoreError:
            return  # where the store may only be read it stays; it is not served all the same

    def put(self, key: str, entry: Entry) -> None:
        """Keep an entry, in place of what is there, in one step; makes room within the quota before.

        Raises
        ------
        StoreError
            The disk is full, the entry is larger than the quota, or the place cannot be reached or written;
            no part of the entry is there.
        """
        check_key(key)
        self._objects.write(key, entry.to_bytes(key))

    def delete(self, key: str) -> None:
        """Remove an entry, where there is one."""
        check_key(key)
        self._objects.delete(key)

    def has(self, key: str) -> bool:
        """Return whether there is such an entry, without reading it: it may yet turn out to be damaged."""
        check_key(key)
        return self._objects.has(key)

    def keys(self, prefix: str = "") -> Iterator[str]:
        """Return an iterator over the keys that begin with `prefix`, in any order."""
        check_prefix(prefix)
        return self._objects.keys(prefix)

    def check_writable(self) -> None:
        """Raise `StoreError` where nothing can be put."""
        self._objects.check_writable()

    def size_bytes(self) -> int:
        """Return what the entries take that count for the quota."""
        return self._objects.size_bytes()


def is_folder(url: str) -> bool:
    """Tell whether a store's URL is a folder of this machine, which may have a quota."""
    return split_protocol(url)[0] in _LOCAL


def open_store(url: str, quota_bytes: int | None = None) -> Store:
    """Return the store at a place; nothing is written yet.

    Parameters
    ----------
    url : str
        Path of a folder, or a URL of fsspec's such as ``s3://bucket/prefix``, see `nacreous.store.remote`.
    quota_bytes : int, optional
        Most that the entries in a folder may take; those used the longest ago make room for new ones.

    Raises
    ------
    StoreError
        The URL's driver is not installed, or a quota is asked of what is no local folder.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     store = open_store(folder)
    ...     store.put("tables/ab/ab12.exr", Entry({"id": "ab12"}, b"a texture"))
    ...     store.get("tables/ab/ab12.exr").payload
    b'a texture'
    """
    if not url:
        raise StoreError("expected a folder or a URL for the store, got an empty name")
    _, path = split_protocol(url)
    if is_folder(url):
        return Store(FolderObjects(Path(path).expanduser(), quota_bytes))
    if quota_bytes is not None:
        place = without_user_info(url)
        raise StoreError(
            f"expected no quota for {place}: only a local folder has one, a bucket has rules of its own"
        )
    return Store(RemoteObjects(url))
