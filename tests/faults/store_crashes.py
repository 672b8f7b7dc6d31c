"""Puts an entry again and again, killed one step later each time: `python store_crashes.py FOLDER QUOTA`.

Python tells its audit hooks of every file that it opens, makes, sizes, locks, renames or removes (PEP 578);
in a fork of this process, such a hook sends the signal. Prints at how many steps it was killed.
"""

import os
import signal
import sys
from itertools import count

from nacreous.store.entry import Entry
from nacreous.store.store import open_store

__all__ = ["KEY", "NEW", "OLD", "OTHERS"]

KEY = "tables/ab/ab12.exr"
OLD, NEW = Entry({"age": "old"}, b"o" * 5000), Entry({"age": "new"}, b"n" * 6000)
OTHERS = ("tables/cd/cd34.exr", "tables/ef/ef56.exr")


def put_killed_at(step: int, folder: str, quota: int) -> None:
    """Replace an entry, and die at the given step of that, if it has so many."""
    store = open_store(folder, quota)
    for key in (*OTHERS, KEY):
        store.put(key, OLD)
    steps = count(1)
    sys.addaudithook(lambda *_: os.kill(os.getpid(), signal.SIGKILL) if next(steps) == step else None)
    store.put(KEY, NEW)
    os._exit(0)


def is_killed_at(step: int, folder: str, quota: int) -> bool:
    """Return whether the put was still going on at that step."""
    child = os.fork()
    if child == 0:
        put_killed_at(step, folder, quota)
    return os.WIFSIGNALED(os.waitpid(child, 0)[1])


def main(folder: str, quota: str) -> None:
    """Make a folder for each step."""
    for step in count(1):
        if not is_killed_at(step, f"{folder}/{step}", int(quota)):
            print(step - 1)
            return


if __name__ == "__main__":
    main(*sys.argv[1:])
