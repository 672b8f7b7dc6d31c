"""Opening what lies in a folder without following a symbolic link on the way.

`O_NOFOLLOW` speaks only of a path's last part (POSIX.1-2017, open), so every folder is opened from the one
above it. A link, a device, a socket or a pipe is not an entry: it is as if it were not there.
"""

import errno
import os
import stat
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

__all__ = ["created_folder", "open_file", "opened_folder", "size_of"]

_FOLDER = os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW
_FILE = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK  # opening a pipe must not wait for its writer


@contextmanager
def opened_folder(root: Path, parts: Sequence[str]) -> Iterator[int]:
    """Yield a descriptor of a folder below `root`; `OSError` where it is not one."""
    with _descended(root, parts, _open_folder) as descriptor:
        yield descriptor


@contextmanager
def created_folder(root: Path, parts: Sequence[str]) -> Iterator[int]:
    """Yield a descriptor of a folder below `root`, which is made where it is missing."""
    root.mkdir(parents=True, exist_ok=True)
    with _descended(root, parts, _create_folder) as descriptor:
        yield descriptor


@contextmanager
def _descended(root: Path, parts: Sequence[str], enter: Callable[[str, int], int]) -> Iterator[int]:
    descriptor = os.open(root, os.O_RDONLY | os.O_DIRECTORY)
    try:
        for part in parts:
            below = enter(part, descriptor)
            os.close(descriptor)
            descriptor = below
        yield descriptor
    finally:
        os.close(descriptor)


def _open_folder(name: str, above: int) -> int:
    return os.open(name, _FOLDER, dir_fd=above)


def _create_folder(name: str, above: int) -> int:
    try:
        return _open_folder(name, above)
    except FileNotFoundError:
        with suppress(FileExistsError):  # another process has been quicker
            os.mkdir(name, dir_fd=above)
        os.fsync(above)
        return _open_folder(name, above)


def open_file(name: str, folder: int) -> BinaryIO:
    """Open a regular file for reading; `FileNotFoundError` where there is none."""
    try:
        descriptor = os.open(name, _FILE, dir_fd=folder)
    except OSError as error:
        if error.errno in (errno.ELOOP, errno.ENXIO):  # a link; a socket
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), name) from error
        raise
    if stat.S_ISREG(os.fstat(descriptor).st_mode):
        return os.fdopen(descriptor, "rb")
    os.close(descriptor)
    raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), name)


def size_of(name: str, folder: int) -> int | None:
    """Return the size of a regular file in bytes; None where there is none."""
    try:
        status = os.stat(name, dir_fd=folder, follow_symlinks=False)
    except FileNotFoundError:
        return None
    return status.st_size if stat.S_ISREG(status.st_mode) else None
