"""The library: every file is looked for in memory, then in the store, and only then computed, once.

A table's record, its spec and certificate, lies beside its files. It is written last, and used whenever one
of them is read from the store, so that it is as a rule the last of the table to be evicted: what goes before
is computed again from it. Once the record is gone the table is unknown, until somebody sends its spec again.
"""

import asyncio
import logging
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from nacreous.engine.coalescing import Coalescing
from nacreous.engine.engine import Engine, Readiness
from nacreous.engine.files import (
    RECORD_SUFFIX,
    check_table_id,
    default_format,
    entries_of,
    file_key,
    format_of_suffix,
    record_entry,
    table_key,
)
from nacreous.engine.hot import Hot
from nacreous.engine.work import Work
from nacreous.errors import MissingError, StoreError
from nacreous.formats.names import FormatName
from nacreous.opencl.tiles import Observer
from nacreous.store.entry import Entry
from nacreous.store.store import Store
from nacreous.tables.spec import Spec
from nacreous.tables.spec_document import Syntax

__all__ = ["Added", "Library", "Record"]

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Record:
    """What is kept of a table beside its files.

    Parameters
    ----------
    id : str
    spec : Spec
        Without labels, which are no part of a table.
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


@dataclass(frozen=True)
class _Outcome:
    """What a computation has made, by suffix, and why the store could not keep it, if it could not."""

    entries: Mapping[str, Entry]
    fault: StoreError | None


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
    uncached : int
        Computations that were answered though the store could not keep them.
    """

    def __init__(self, store: Store, engine: Engine, hot_bytes: int = 256 * 2**20) -> None:
        self._store, self._engine = store, engine
        self._hot = Hot(hot_bytes)
        self._reads = Coalescing[Entry]()
        self._works = Coalescing[_Outcome]()
        self.hits_memory = self.hits_store = self.misses = self.uncached = 0

    @property
    def coalesced(self) -> int:
        """Requests that waited for what another had begun."""
        return self._reads.joined + self._works.joined

    @property
    def ready(self) -> bool:
        """Whether the engine takes work."""
        return self._engine.state.readiness is Readiness.READY

    def hot(self, table_id: str, suffix: str) -> Entry | None:
        """Return a file that is in memory, at once; None where it is not, which says nothing of the store."""
        entry = self._hot.get(table_key(table_id, suffix))
        self.hits_memory += entry is not None
        return entry

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
        await _identify(work)
        key = file_key(work, suffix)
        entry = self._hot.get(key)
        if entry is not None:
            self.hits_memory += 1
            return entry
        return await self._reads.share(key, lambda _: self._found(work, suffix or work.target.suffix))

    async def table_file(self, table_id: str, suffix: str) -> Entry:
        """Return a file of a known table, such as its ``".transmission.exr"``.

        What has been evicted, or was never computed in that format, is computed from the table's record.

        Raises
        ------
        MissingError
            There is no such table, no format of this suffix, or the table has no such companion.
        StoreError
            The table's record cannot be read, where it is needed.
        SpecError
            The format cannot hold the table; and all that `file` raises.
        """
        check_table_id(table_id)
        target = format_of_suffix(suffix)
        key = table_key(table_id, suffix)
        return self.hot(table_id, suffix) or await self._reads.share(
            key, lambda _: self._recalled(table_id, target.name, suffix)
        )

    async def add(self, spec: Spec) -> Added:
        """Compute a spec in its default format, keep its record, and say what came of it.

        Two who add the same at once are both told that it was unknown. Raises what `file` raises.
        """
        work = Work(spec, default_format(spec))
        await _identify(work)
        known = await asyncio.to_thread(self._read, table_key(work.id, RECORD_SUFFIX), work.id)
        certificate = (await self.file(work)).facts["certificate"]
        return Added(work.id, certificate, created=known is None)

    async def record(self, table_id: str) -> Record:
        """Return what is known of a table; raises `MissingError`, or `StoreError` where nobody can tell."""
        check_table_id(table_id)
        key = table_key(table_id, RECORD_SUFFIX)
        entry = self._hot.get(key) or await asyncio.to_thread(self._store.get, key)
        if entry is None:
            raise MissingError(f"there is no table {table_id}; send its spec to have it computed")
        self._hot.put(key, entry)
        return Record(table_id, Spec.from_text(entry.payload, Syntax.JSON), entry.facts["certificate"])

    async def holds(self, work: Work, suffix: str = "") -> bool:
        """Tell whether a file of a work is there, and need not be computed; see `file`."""
        await _identify(work)
        key = file_key(work, suffix)
        return self._hot.get(key) is not None or await asyncio.to_thread(self._is_stored, key)

    async def keep(
        self, work: Work, observer: Observer | None = None, deadline_s: float | None = None
    ) -> None:
        """See to it that every file of a work is in the store, within the engine's deadline or another.

        Raises what `file` raises, and `StoreError` where the files cannot be kept.
        """
        await _identify(work)
        if await asyncio.to_thread(self._is_kept, work):
            return
        computed = partial(self._computed, work, deadline_s=deadline_s)
        outcome = await self._works.share(file_key(work), computed, observer)
        if outcome.fault is not None:
            raise outcome.fault

    def _is_kept(self, work: Work) -> bool:
        """Tell whether the last of what is stored of a work is there: its record, and its own file."""
        return all(map(self._store.has, (table_key(work.id, RECORD_SUFFIX), file_key(work))))

    async def settle(self) -> None:
        """Wait until what is being computed has been answered and stored; stop the engine before."""
        await self._reads.settle()
        await self._works.settle()

    async def _found(self, work: Work, suffix: str) -> Entry:
        key = file_key(work, suffix)
        entry = await asyncio.to_thread(self._read, key, work.id, work)
        return self._hit(key, entry) if entry else await self._made(work, suffix)

    async def _recalled(self, table_id: str, chosen: FormatName, suffix: str) -> Entry:
        key = table_key(table_id, suffix)
        entry = await asyncio.to_thread(self._read, key, table_id)
        if entry is not None:
            return self._hit(key, entry)
        work = await _work_of(await self.record(table_id), chosen)
        return await self._made(work, suffix)

    def _hit(self, key: str, entry: Entry) -> Entry:
        self.hits_store += 1
        self._hot.put(key, entry)
        return entry

    async def _made(self, work: Work, suffix: str) -> Entry:
        await self._check_companion(work, suffix)
        self.misses += 1
        outcome = await self._works.share(file_key(work), partial(self._computed, work))
        for each, made in outcome.entries.items():
            self._hot.put(file_key(work, each), made)
        return _chosen(outcome, suffix, work)

    async def _check_companion(self, work: Work, suffix: str) -> None:
        """Refuse a companion that the table's own file says there is none of, before computing it again."""
        if suffix == work.target.suffix:
            return
        key = file_key(work)
        own = self._hot.get(key) or await asyncio.to_thread(self._read, key, work.id)
        if own is not None and suffix not in own.facts["files"]:
            raise _no_companion(work, suffix)

    async def _computed(self, work: Work, observer: Observer, deadline_s: float | None = None) -> _Outcome:
        product = await self._engine.compute(work, observer, deadline_s)
        observer(1.0)
        entries = entries_of(work, product)
        fault = await asyncio.to_thread(self._kept, work, entries)
        if fault is not None:
            self.uncached += 1
            _log.warning("table %s was answered and not kept: %s", work.id, fault)
        key, record = _record_of(work, entries)
        if _speaks(work) or self._hot.get(key) is None:
            self._hot.put(key, record)
        return _Outcome(entries, fault)

    def _kept(self, work: Work, entries: Mapping[str, Entry]) -> StoreError | None:
        """Store a product and its record, in a thread, and compute what its files are known by."""
        for entry in entries.values():
            entry.sha256  # noqa: B018 - computed here once, and not in the event loop
        try:
            for suffix, entry in entries.items():
                self._store.put(file_key(work, suffix), entry)
            key, record = _record_of(work, entries)
            if _speaks(work) or not self._store.has(key):
                self._store.put(key, record)
        except StoreError as error:
            return error
        return None

    def _is_stored(self, key: str) -> bool:
        try:
            return self._store.has(key)
        except StoreError as error:
            _log.warning("%s could not be looked for: %s", key, error)
            return False

    def _read(self, key: str, table_id: str, work: Work | None = None) -> Entry | None:
        """Read an entry, in a thread, and use its table's record; write that of `work` where it is gone.

        A store that fails is one that has nothing.
        """
        record_key = table_key(table_id, RECORD_SUFFIX)
        try:
            entry = self._store.get(key)
            if entry is not None:
                entry.sha256  # noqa: B018 - computed here once, and not in the event loop
                if self._store.get(record_key) is None and work is not None:
                    self._store.put(record_key, record_entry(work.spec, table_id, entry.facts["certificate"]))
        except StoreError as error:
            _log.warning("%s could not be read: %s", key, error)
            return None
        return entry


async def _identify(work: Work) -> None:
    """Have the id of a work computed in a thread, once: its materials are read for it."""
    if "id" not in vars(work):
        await asyncio.to_thread(getattr, work, "id")


async def _work_of(record: Record, chosen: FormatName) -> Work:
    """Return the work of a record; one of an earlier version would be of another table."""
    work = Work(record.spec, chosen)
    await _identify(work)
    if work.id != record.id:
        raise MissingError(f"table {record.id} is of another version of Nacreous; send its spec again")
    return work


def _speaks(work: Work) -> bool:
    """Tell whether it is this format's certificate that the record is to have."""
    return work.format is default_format(work.spec)


def _record_of(work: Work, entries: Mapping[str, Entry]) -> tuple[str, Entry]:
    certificate = entries[work.target.suffix].facts["certificate"]
    return table_key(work.id, RECORD_SUFFIX), record_entry(work.spec, work.id, certificate)


def _chosen(outcome: _Outcome, suffix: str, work: Work) -> Entry:
    try:
        return outcome.entries[suffix]
    except KeyError:
        raise _no_companion(work, suffix) from None


def _no_companion(work: Work, suffix: str) -> MissingError:
    return MissingError(f"table {work.id} has no file {suffix}: there is nothing that it would hold")
