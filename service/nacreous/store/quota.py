"""How much a folder may hold, and what goes first when there is no more room.

The entry used the longest ago goes first (LRU), after anything in quarantine. What lies in ``jobs/`` neither
counts nor goes. Room for a sixteenth of the quota is made at once: looking through the folder then costs
little for each entry that is put, and a put that finds room looks at one number.
"""

import math
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from nacreous.errors import StoreError
from nacreous.store.census import Found, found_below
from nacreous.store.incoming import is_incoming, remove_abandoned
from nacreous.store.keys import QUARANTINE
from nacreous.store.ledger import Account, held
from nacreous.store.nofollow import opened_folder

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
            They never would, or what is being written by others leaves no room.
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
                f"what others write just now leaves no room for {size} bytes within the store's quota"
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
            with opened_folder(self._root, file.folders) as folder, suppress(FileNotFoundError):
                os.unlink(file.name, dir_fd=folder)
            total_bytes -= file.size
            self.evicted += 1
        account.total_bytes = total_bytes


def _worth(file: Found) -> tuple[bool, int]:
    """Return what orders files from the one to go first."""
    return file.folders[:1] != (QUARANTINE,), file.used_ns
