"""One file in a folder that only one thread of one process holds at a time, and the number that it keeps.

Whatever changes what lies in the folder is done while it is held. A process that ends lets go of it
(flock(2)); one that is killed between a change and the number leaves the number too large, never too small.
"""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

__all__ = ["Account", "held"]

_NAME = ".lock"
_DIGITS = 20
"""Of the number, always: it is written over in place, which needs no room on a full disk."""


class Account:
    """The number of bytes in the folder, while its ledger is held."""

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor

    @property
    def is_kept(self) -> bool:
        """Whether there is a number at all: not in a new folder, nor after somebody has removed the file."""
        return os.pread(self._descriptor, _DIGITS, 0).isdigit()

    @property
    def total_bytes(self) -> int:
        """What is in the folder and counts."""
        return int(os.pread(self._descriptor, _DIGITS, 0))

    @total_bytes.setter
    def total_bytes(self, count: int) -> None:
        os.pwrite(self._descriptor, b"%0*d" % (_DIGITS, max(count, 0)), 0)


@contextmanager
def held(root: Path) -> Iterator[Account]:
    """Wait for the ledger of a folder, and hold it."""
    descriptor = os.open(root / _NAME, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o666)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        try:
            yield Account(descriptor)
        finally:
            # Closing would not do where another thread is just starting a process, which has it open too.
            fcntl.flock(descriptor, fcntl.LOCK_UN)
    finally:
        os.close(descriptor)
