"""Files in memory, the least recently used of which make room."""

from collections import OrderedDict

from nacreous.store.entry import Entry

__all__ = ["Hot"]

_OVERHEAD_BYTES = 4_096
"""About what an entry takes beside its payload: its certificate, its key and its place."""


class Hot:
    """At most `limit_bytes` of entries by their keys; one larger than that is not kept.

    Parameters
    ----------
    limit_bytes : int

    Attributes
    ----------
    size_bytes : int
        What is kept now.
    """

    def __init__(self, limit_bytes: int) -> None:
        self._limit_bytes = limit_bytes
        self._entries: OrderedDict[str, Entry] = OrderedDict()
        self.size_bytes = 0

    def __len__(self) -> int:
        return len(self._entries)

    def get(self, key: str) -> Entry | None:
        """Return an entry, and mark it as used."""
        entry = self._entries.get(key)
        if entry is not None:
            self._entries.move_to_end(key)
        return entry

    def put(self, key: str, entry: Entry) -> None:
        """Keep an entry in place of those least recently used."""
        self._forget(key)
        if _bytes_of(entry) > self._limit_bytes:
            return
        self._entries[key] = entry
        self.size_bytes += _bytes_of(entry)
        while self.size_bytes > self._limit_bytes:
            self._forget(next(iter(self._entries)))

    def _forget(self, key: str) -> None:
        entry = self._entries.pop(key, None)
        if entry is not None:
            self.size_bytes -= _bytes_of(entry)


def _bytes_of(entry: Entry) -> int:
    return len(entry.payload) + _OVERHEAD_BYTES
