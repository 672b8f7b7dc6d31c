"""Everything that lies in a folder and below it, without following symbolic links."""

import os
import stat
from collections.abc import Iterator
from dataclasses import dataclass

from nacreous.store.recency import last_used_ns

__all__ = ["Found", "found_below"]


@dataclass(frozen=True)
class Found:
    """A regular file.

    Parameters
    ----------
    folders : tuple of str
        Names of the folders that it is in, from the outermost.
    name : str
    size : int
        In bytes.
    used_ns : int
        When it was last used.
    """

    folders: tuple[str, ...]
    name: str
    size: int
    used_ns: int

    @property
    def is_hidden(self) -> bool:
        """Whether it is no entry: the ledger, or a file that is being written."""
        return self.name.startswith(".")

    @property
    def path(self) -> str:
        """Name with those of its folders, ``/`` between them."""
        return "/".join((*self.folders, self.name))


def found_below(folder: int) -> Iterator[Found]:
    """Yield each regular file below an open folder; what comes and goes meanwhile may be among them."""
    for path, _, names, descriptor in os.fwalk(".", dir_fd=folder, onerror=_fail):
        folders = tuple(path.split("/")[1:])
        for name in names:
            status = _status(name, descriptor)
            if status is not None and stat.S_ISREG(status.st_mode):
                yield Found(folders, name, status.st_size, last_used_ns(status))


def _fail(error: OSError) -> None:
    raise error


def _status(name: str, folder: int) -> os.stat_result | None:
    try:
        return os.stat(name, dir_fd=folder, follow_symlinks=False)
    except FileNotFoundError:
        return None
