"""What a store needs of the place where its objects lie."""

from collections.abc import Iterator
from typing import Protocol

__all__ = ["Objects"]


class Objects(Protocol):
    """Bytes by name, each written as a whole or not at all; used from several threads and processes.

    Every method raises `StoreError` where the place cannot be reached, read or written.
    """

    @property
    def evicted(self) -> int:
        """How many objects this process has removed to make room."""
        ...

    def read(self, key: str) -> bytes | None:
        """Return an object, and remember that it has been used; None where there is none."""
        ...

    def write(self, key: str, stored: bytes) -> None:
        """Put an object in place of what is there, in one step."""
        ...

    def set_aside(self, key: str, damaged: bytes) -> None:
        """Move an object to the quarantine, unless it has been replaced by another one than `damaged`."""
        ...

    def delete(self, key: str) -> None:
        """Remove an object, where there is one."""
        ...

    def has(self, key: str) -> bool:
        """Return whether there is such an object, without reading it."""
        ...

    def keys(self, prefix: str) -> Iterator[str]:
        """Yield the names that begin with `prefix`, in any order."""
        ...

    def check_writable(self) -> None:
        """Write something and remove it again."""
        ...

    def size_bytes(self) -> int:
        """Return what the objects take that count for the quota."""
        ...
