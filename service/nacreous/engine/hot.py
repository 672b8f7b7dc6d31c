"""Files in memory, the least recently used of which make room."""

from nacreous.store.entry import Entry

__all__ = ["Hot"]


class Hot:
    """At most `limit_bytes` of entries by their keys; one larger than that is not kept."""

    def __init__(self, limit_bytes: int) -> None:
        raise NotImplementedError

    def get(self, key: str) -> Entry | None:
        """Return an entry, and mark it as used."""
        raise NotImplementedError

    def put(self, key: str, entry: Entry) -> None:
        """Keep an entry, with its checksum computed, in place of the least recently used."""
        raise NotImplementedError
