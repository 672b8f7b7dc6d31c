"""How much a folder may hold, and what goes first when there is no more room.

The entry used the longest ago goes first (LRU), after anything in quarantine. What lies in ``jobs/`` neither
counts nor goes. Room for a sixteenth of the quota is made at once: looking through the folder then costs
little for each entry that is put, and a put that finds room looks at one number. Files that are no entries
count, and stay.
"""

import math
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from nacreous.errors import StoreError
from nacreous.store.census import Found, found_below
from nacreous.store.entry import BEGINNING, begins_as_entry
from nacreous.store.incoming import is_incoming, remove_abandoned
from nacreous.store.keys import QUARANTINE
from nacreous.store.ledger import Account, held
from nacreous.store.nofollow import open_file, opened_folder

__all__ = ["Quota", "counted_bytes"]

_JOBS = "jobs"
_SHARE_FREED = 16


def counted_bytes(folders: Sequence[str], size: int) -> int:
    """Return what a file in these folders counts of its size."""
    return 0 if folders and folders[0] == _JOBS else size


class Quota:
    """The limit of a folder, kept by every process that writes to it.

    Parameters
    ----------
    root : Path
    limit_bytes : int or None
        Sum of the sizes of files; None for no limit.
    """

    def __init__(self, root: Path, limit_bytes: int | None) -> None:
        self._root, self._limit = root, math.inf if limit_bytes is None else limit_bytes
        self._has_counted = False
        self.evicted = 0
        """How many entries this process has removed."""

    @contextmanager
    def held(self) -> Iterator[Account]:
        """Hold the folder's ledger.

        The first time in a process all is counted: a machine that lost its power may have lost the number's
        last change, and somebody may have copied files into the folder.
        """
        with held(self._root) as account:
            if not self._has_counted or not account.is_kept:
                self._recount(account)
                self._has_counted = True
            yield account

    def make_room(self, account: Account, size: int) -> None:
        """Evict until `size` more bytes fit.

        Raises
        ------
        StoreError
            They never would, or files that are no entries, or that others write just now, leave no room.
        """
        if account.total_bytes + size <= self._limit:
            return
        if size > self._limit:
            raise StoreError(
                f"expected an entry within the store's quota of {self._limit} bytes, got one of {size}"
            )
        entries = self._recount(account)
        if account.total_bytes + size > self._limit:
            self._evict(account, entries, self._limit - size)
        if account.total_bytes + size > self._limit:
            raise StoreError(
                f"files that cannot be evicted leave no room for {size} bytes within the store's quota"
            )

    def _recount(self, account: Account) -> list[Found]:
        """Put the ledger right, and return what may be evicted."""
        with opened_folder(self._root, ()) as root:
            found = [file for file in found_below(root) if self._stays(file)]
        account.total_bytes = sum(counted_bytes(file.folders, file.size) for file in found)
        return [file for file in found if not file.is_hidden and counted_bytes(file.folders, 1)]

    def _stays(self, file: Found) -> bool:
        """Return whether a file is an entry or becomes one; what a killed writer has left is removed."""
        if not is_incoming(file.name):
            return not file.is_hidden
        with opened_folder(self._root, file.folders) as folder:
            return not remove_abandoned(file.name, folder)

    def _evict(self, account: Account, entries: Sequence[Found], goal_bytes: float) -> None:
        """Remove entries until the total is at most `goal_bytes` less a sixteenth of the quota."""
        goal_bytes -= self._limit // _SHARE_FREED
        total_bytes = account.total_bytes
        for file in sorted(entries, key=_worth):
            if total_bytes <= goal_bytes:
                break
            total_bytes -= self._remove(file)
        account.total_bytes = total_bytes

    def _remove(self, file: Found) -> int:
        """Remove an entry, and return what it took; a file that is none, and no damaged one, stays."""
        with opened_folder(self._root, file.folders) as folder, suppress(FileNotFoundError):
            if file.folders[:1] != (QUARANTINE,) and not _is_entry(file.name, folder):
                return 0
            os.unlink(file.name, dir_fd=folder)
            self.evicted += 1
        return file.size


def _is_entry(name: str, folder: int) -> bool:
    """Return whether a file begins as an entry does: the store may be among files of other people."""
    with open_file(name, folder) as file:
        return begins_as_entry(file.read(BEGINNING))


def _worth(file: Found) -> tuple[bool, int]:
    """Return what orders files from the one to go first."""
    return file.folders[:1] != (QUARANTINE,), file.used_ns
