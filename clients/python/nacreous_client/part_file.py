"""A file that is arriving: at its path once it is complete, and until then beside it under a hidden name.

A later call goes on with what it finds there. The hidden name holds the checksum of the file that is to
come, so that nothing is ever appended to a part of another. Who writes a part holds a lock on it (flock);
where another holds it already, or the system has no such locks, the part is private to the call and gone
after it.
"""

import hashlib
import os
import re
import secrets
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

try:
    from fcntl import LOCK_EX, LOCK_NB, flock
except ImportError:  # Windows

    def _lock(file: BinaryIO) -> bool:  # noqa: ARG001 - there is nothing to lock it with
        return False

else:

    def _lock(file: BinaryIO) -> bool:
        try:
            flock(file, LOCK_EX | LOCK_NB)
        except OSError:  # another's, or a file system without locks
            return False
        return True


__all__ = ["PartFile"]

_TAG = re.compile(r"\.nacreous-[0-9a-f]{16}-([0-9a-f]{64})\.part")
_BLOCK_BYTES = 2**20


class PartFile:
    """What has arrived so far of a file.

    Parameters
    ----------
    path : Path
        Where the complete file is to be; its folder exists.

    Attributes
    ----------
    sha256 : str
        Checksum, in hex, of the complete file; empty where nothing has arrived.
    size : int
        Bytes that have arrived.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._part: Path | None = None
        self._file: BinaryIO | None = None
        self._private = False
        self._forget()

    def _forget(self) -> None:
        self.sha256, self.size, self._digest = "", 0, hashlib.sha256()

    def resume(self) -> None:
        """Go on with what an earlier call has left, if it has."""
        for part, sha256 in self._left():
            file = part.open("r+b")
            if _lock(file) and part.exists():
                self._part, self._file = part, file
                self.sha256 = sha256
                while block := file.read(_BLOCK_BYTES):
                    self._count(block)
                return
            file.close()

    def _left(self) -> Iterator[tuple[Path, str]]:
        """Yield the parts of the file that lie there, and the checksums in their names."""
        for part in sorted(self._path.parent.glob(f".nacreous-{self._hash()}-*.part")):
            if match := _TAG.fullmatch(part.name):
                yield part, match[1]

    def _hash(self) -> str:
        """Return what stands for the file's name, which may be as long as a name can be."""
        return hashlib.sha256(self._path.name.encode()).hexdigest()[:16]

    def begin(self, sha256: str) -> None:
        """Begin anew, with a file of this checksum; what has arrived of another is dropped."""
        self.discard()
        self.sha256 = sha256
        shared = self._path.with_name(f".nacreous-{self._hash()}-{sha256}.part")
        file = shared.open("a+b")
        self._private = not _lock(file)
        if not self._private:
            file.truncate(0)
            self._part, self._file = shared, file
            return
        file.close()
        self._part = self._path.with_name(f".nacreous-{secrets.token_hex(8)}.part")
        self._file = self._part.open("xb")

    def append(self, chunk: bytes) -> None:
        """Add bytes at the end."""
        if self._file is None:
            raise ValueError("a part is begun before bytes are appended to it")
        self._file.write(chunk)
        self._file.flush()  # what has come outlives the process, if it is killed
        self._count(chunk)

    def _count(self, block: bytes) -> None:
        self._digest.update(block)
        self.size += len(block)

    @property
    def intact(self) -> bool:
        """Whether what has arrived is the complete file."""
        return bool(self.sha256) and self._digest.hexdigest() == self.sha256

    def complete(self) -> None:
        """Put the file in its place, in one step, once it is safe on the disk."""
        if self._file is None or self._part is None:
            raise ValueError("nothing has arrived that could be put in place")
        self._file.flush()
        os.fsync(self._file.fileno())
        self._file.close()
        self._part.replace(self._path)
        self._file = self._part = None
        _bring_to_disk(self._path.parent)

    def discard(self) -> None:
        """Drop what has arrived. It is unlinked, never emptied: it may be in its place by another name."""
        if self._part is not None:
            self._part.unlink(missing_ok=True)
        self._close()
        self._forget()

    def leave(self) -> None:
        """Stop, and leave what has arrived to a later call."""
        if self._part is not None and (self._private or not self.size):
            self._part.unlink(missing_ok=True)
        self._close()

    def _close(self) -> None:
        if self._file is not None:
            self._file.close()
        self._file = self._part = None


def _bring_to_disk(folder: Path) -> None:
    """Wait until the names in a folder would outlive a power failure, where the system can be told to."""
    if os.name != "posix":
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
