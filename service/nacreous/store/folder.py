"""Objects in a local folder, which several processes may share.

A new object is written under a hidden name in the folder that it is for, brought to the disk, and renamed;
the folder is brought to the disk then. Who reads an object holds its file open, so that it can be replaced or
evicted meanwhile. The file system must have `flock`.
"""

import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from nacreous.errors import StoreError, reason
from nacreous.store.census import found_below
from nacreous.store.incoming import IncomingFile
from nacreous.store.keys import QUARANTINE, is_key
from nacreous.store.nofollow import created_folder, open_file, opened_folder, size_of
from nacreous.store.quota import Quota, counted_bytes
from nacreous.store.recency import mark_used_again

__all__ = ["FolderObjects"]

_ABSENT = (FileNotFoundError, NotADirectoryError)
"""What opening says where there is no such object, or a link on the way to it."""
_PROBE = bytes(4096)
"""One page: a full file system may have a name left, but no room."""


class FolderObjects:
    """Objects in a folder, which is made with the first of them.

    Parameters
    ----------
    root : Path
        The folder, or a link to it.
    quota_bytes : int, optional
        Most that its files may take, see `nacreous.store.quota`; without one, nothing is ever evicted.
    """

    def __init__(self, root: Path, quota_bytes: int | None = None) -> None:
        self._root, self._quota = root, Quota(root, quota_bytes)

    @property
    def evicted(self) -> int:
        """How many objects this process has removed to make room."""
        return self._quota.evicted

    def read(self, key: str) -> bytes | None:
        """Return an object, and remember that it has been used; None where there is none."""
        *folders, name = key.split("/")
        with (
            _unless_absent(f"{key} cannot be read from the store"),
            opened_folder(self._root, folders) as folder,
            open_file(name, folder) as file,
        ):
            stored = file.read()
            mark_used_again(file.fileno())
            return stored
        return None

    def write(self, key: str, stored: bytes) -> None:
        """Put an object in place of what is there, in one step, and make room for it before."""
        *folders, name = key.split("/")
        size = counted_bytes(folders, len(stored))
        with _explained(f"{key} cannot be kept in the store"), created_folder(self._root, folders) as folder:
            with self._incoming(folder, len(stored), size) as file:
                file.fill(stored)
                with self._quota.held() as account:
                    replaced = counted_bytes(folders, size_of(name, folder) or 0)
                    file.put_in_place(name)
                    account.total_bytes -= replaced
            os.fsync(folder)

    @contextmanager
    def _incoming(self, folder: int, size: int, counted: int) -> Iterator[IncomingFile]:
        """Yield a new hidden file for which there is room; what fails gives the room back."""
        with self._quota.held() as account:
            self._quota.make_room(account, counted)
            account.total_bytes += counted
            file = IncomingFile(folder, size)
        with file:
            try:
                yield file
            except BaseException:
                with self._quota.held() as account:
                    if file.discard():
                        account.total_bytes -= counted
                raise

    def set_aside(self, key: str, damaged: bytes) -> None:
        """Move an object to the quarantine, unless it has been replaced by another one than `damaged`."""
        *folders, name = key.split("/")
        with (
            _unless_absent(f"{key} cannot be put into quarantine"),
            opened_folder(self._root, folders) as folder,
            created_folder(self._root, [QUARANTINE]) as quarantine,
            self._quota.held() as account,
        ):
            if _content(name, folder) == damaged:
                account.total_bytes += len(damaged) - counted_bytes(folders, len(damaged))
                aside = f"{secrets.token_hex(8)}-{name[-200:]}"
                os.rename(name, aside, src_dir_fd=folder, dst_dir_fd=quarantine)

    def delete(self, key: str) -> None:
        """Remove an object, where there is one."""
        *folders, name = key.split("/")
        with (
            _unless_absent(f"{key} cannot be removed from the store"),
            opened_folder(self._root, folders) as folder,
            self._quota.held() as account,
        ):
            size = size_of(name, folder)
            if size is not None:
                os.unlink(name, dir_fd=folder)
                account.total_bytes -= counted_bytes(folders, size)
                os.fsync(folder)

    def has(self, key: str) -> bool:
        """Return whether there is such an object, without reading it."""
        *folders, name = key.split("/")
        with (
            _unless_absent(f"{key} cannot be looked for in the store"),
            opened_folder(self._root, folders) as folder,
        ):
            return size_of(name, folder) is not None
        return False

    def keys(self, prefix: str) -> Iterator[str]:
        """Yield the names that begin with `prefix`, in any order."""
        *folders, _ = prefix.split("/")
        with (
            _unless_absent("the store cannot be listed"),
            opened_folder(self._root, folders) as folder,
        ):
            for file in found_below(folder):
                key = "/".join((*folders, file.path))
                if key.startswith(prefix) and is_key(key):
                    yield key

    def check_writable(self) -> None:
        """Write a hidden file and remove it again."""
        with (
            _explained(f"the store {self._root} cannot be written"),
            created_folder(self._root, ()) as folder,
        ):
            with self._quota.held():
                file = IncomingFile(folder, len(_PROBE))
            with file:
                file.fill(_PROBE)

    def size_bytes(self) -> int:
        """Return what the objects take that count for the quota, from the folder's ledger."""
        with (
            _unless_absent(f"the store {self._root} cannot be counted"),
            self._quota.held() as account,
        ):
            return account.total_bytes
        return 0


def _content(name: str, folder: int) -> bytes:
    with open_file(name, folder) as file:
        return file.read()


@contextmanager
def _explained(failure: str) -> Iterator[None]:
    """Say what has failed where the operating system says only why."""
    try:
        yield
    except OSError as error:
        raise StoreError(f"{failure}: {reason(error)}") from error


@contextmanager
def _unless_absent(failure: str) -> Iterator[None]:
    """Go on after the block where the object in it is not there; other failures are explained."""
    with _explained(failure), suppress(*_ABSENT):
        yield
