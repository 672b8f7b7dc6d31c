"""When an entry was last used: its file's time of modification, as entries are never modified.

The time of access would change with every backup, and not at all on file systems mounted with ``noatime``.
"""

import os
import time
from contextlib import suppress

__all__ = ["last_used_ns", "mark_used", "mark_used_again"]

_FRESH_NS = 10 * 10**9
"""Within this time another mark says nothing new, and would make each read a write to the disk."""


def last_used_ns(status: os.stat_result) -> int:
    """Return when a file was last marked, in nanoseconds since 1970."""
    return status.st_mtime_ns


def mark_used(descriptor: int) -> None:
    """Say that a file is used now: finer than the kernel's own tick, which many writes would share."""
    now = time.time_ns()
    os.utime(descriptor, ns=(now, now))


def mark_used_again(descriptor: int) -> None:
    """Say that a file is used now, unless that was said a moment ago."""
    if time.time_ns() - last_used_ns(os.fstat(descriptor)) > _FRESH_NS:
        with suppress(OSError):  # a store that may only be read is read all the same
            mark_used(descriptor)
