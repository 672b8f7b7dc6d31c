"""A file on its way into the store: hidden, and of its full size from the start.

It is locked while its writer lives. The system gives up the lock of a process however it ends (flock(2)), so
a hidden file whose lock can be had has been abandoned, and nobody needs to guess by its age.
"""

import fcntl
import os
import re
import secrets
from typing import Self

from nacreous.store.nofollow import open_file
from nacreous.store.recency import mark_used

__all__ = ["IncomingFile", "is_incoming", "remove_abandoned"]

_HIDDEN = re.compile(r"\.nacreous-[0-9a-f]{16}\.part", re.ASCII)
_MODE = 0o666  # less the umask, as any file


class IncomingFile:
    """A hidden file in a folder; closing it removes it, unless it has been put in place.

    Make it while the folder's ledger is held: else it could be swept in the moment before it is locked.

    Parameters
    ----------
    folder : int
        Descriptor of the folder, open for as long as this file.
    size : int
        Number of bytes it will have: whoever counts the folder meanwhile counts them too.
    """

    def __init__(self, folder: int, size: int) -> None:
        self._folder, self._name = folder, f".nacreous-{secrets.token_hex(8)}.part"
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW
        self._descriptor = os.open(self._name, flags, _MODE, dir_fd=folder)
        try:
            fcntl.flock(self._descriptor, fcntl.LOCK_EX)
            os.ftruncate(self._descriptor, size)
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def fill(self, stored: bytes) -> None:
        """Write the content, and wait until it would outlive a power failure."""
        with open(self._descriptor, "wb", closefd=False) as file:
            file.write(stored)
        mark_used(self._descriptor)
        os.fsync(self._descriptor)

    def put_in_place(self, name: str) -> None:
        """Give the file its name, in place of one that has it now, in one step (POSIX.1-2017, rename)."""
        os.rename(self._name, name, src_dir_fd=self._folder, dst_dir_fd=self._folder)

    def discard(self) -> bool:
        """Remove the file, unless it has been put in place; return whether it was there to remove."""
        try:
            os.unlink(self._name, dir_fd=self._folder)
        except FileNotFoundError:
            return False
        return True

    def close(self) -> None:
        """Discard the file, and let go of it."""
        self.discard()
        os.close(self._descriptor)


def is_incoming(name: str) -> bool:
    """Return whether a file's name is a hidden one of this module."""
    return _HIDDEN.fullmatch(name) is not None


def remove_abandoned(name: str, folder: int) -> bool:
    """Remove a hidden file whose writer has ended; return whether it had."""
    try:
        with open_file(name, folder) as file:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            os.unlink(name, dir_fd=folder)
    except BlockingIOError:
        return False
    except FileNotFoundError:
        pass  # put in place since
    return True
