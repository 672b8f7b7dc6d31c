"""The library: every file is looked for in memory, then in the store, and only then computed, once.

A table's record, its spec and certificate, lies beside its files. It is touched whenever one of them is read
from the store, so it is the last of the table to be evicted, and what is evicted before is computed again
from it.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from nacreous.engine.engine import Engine
from nacreous.engine.work import Work
from nacreous.formats.names import FormatName
from nacreous.opencl.tiles import Observer
from nacreous.store.entry import Entry
from nacreous.store.store import Store
from nacreous.tables.spec import Spec

__all__ = ["Added", "Library", "Record", "default_format", "file_key"]


@dataclass(frozen=True)
class Record:
    """What is kept of a table beside its files.

    Parameters
    ----------
    id : str
    spec : Spec
    certificate : mapping
        Of the table's default format, or of the one that was computed first.
    """

    id: str
    spec: Spec
    certificate: Mapping[str, Any]


@dataclass(frozen=True)
class Added:
    """What became of a spec: its table's id and certificate, and whether it was unknown before."""

    id: str
    certificate: Mapping[str, Any]
    created: bool


def default_format(spec: Spec) -> FormatName:
    """Return the format that every table is computed in first: exr where it has colour, else npz."""
    raise NotImplementedError


def file_key(work: Work, suffix: str = "") -> str:
    """Return the key in the store of a file of a work; without `suffix` of the format's own."""
    raise NotImplementedError


class Library:
    """Finished files, by what is in them; used from one event loop.

    Parameters
    ----------
    store : Store
    engine : Engine
    hot_bytes : int
        Bytes of files that are kept in memory.

    Attributes
    ----------
    hits_memory, hits_store, misses : int
        Where files were found, or not.
    coalesced : int
        Requests that waited for a computation that another had begun.
    uncached : int
        Files that were answered though the store could not keep them.
    """

    def __init__(self, store: Store, engine: Engine, hot_bytes: int = 256 * 2**20) -> None:
        raise NotImplementedError

    def hot(self, id: str, suffix: str) -> Entry | None:
        """Return a file that is in memory, at once; None where it is not (which says nothing of the store).

        Examples
        --------
        ``library.hot(table_id, ".transmission.exr")``
        """
        raise NotImplementedError

    async def file(self, work: Work, suffix: str = "") -> Entry:
        """Return a file of a work, and compute it where it is nowhere.

        Parameters
        ----------
        work : Work
        suffix : str, optional
            Of a companion, such as ``".transmission.exr"``; the format's own file without it.

        Raises
        ------
        MissingError
            The table has no such companion.
        SpecError, BudgetError, DeviceError, NumericalError, FileFormatError
            The table cannot be computed or written.
        BusyError, UnavailableError, DeadlineError
            The engine cannot compute it now.
        """
        raise NotImplementedError

    async def table_file(self, id: str, suffix: str) -> Entry:
        """Return a file of a known table: ``await library.table_file(id, ".transmission.exr")``.

        What has been evicted, or was never computed in that format, is computed from the table's record.

        Raises
        ------
        MissingError
            There is no such table, no format of this suffix, or the table has no such companion.
        SpecError
            The format cannot hold the table; and all that `file` raises.
        """
        raise NotImplementedError

    async def add(self, spec: Spec) -> Added:
        """Compute a spec in its default format, keep its record, and say what came of it.

        Raises what `file` raises.
        """
        raise NotImplementedError

    async def record(self, id: str) -> Record:
        """Return what is known of a table; raises `MissingError`."""
        raise NotImplementedError

    async def keep(self, work: Work, observer: Observer | None = None) -> None:
        """See to it that every file of a work is in the store; raises `StoreError` where that cannot be."""
        raise NotImplementedError

    async def settle(self) -> None:
        """Wait until what is being computed has been answered and stored; stop the engine before."""
        raise NotImplementedError
