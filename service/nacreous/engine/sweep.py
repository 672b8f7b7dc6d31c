"""A sweep: a base and what varies; the tables of a job, or of a batch."""

from typing import Any, Self

from nacreous.engine.work import Work
from nacreous.optics.value import StrictModel
from nacreous.tables.axes import Range
from nacreous.tables.spec import Spec
from nacreous.tables.spec_document import Document

__all__ = ["MAX_TABLES", "Sweep"]

MAX_TABLES = 10_000
"""Tables of a sweep, where its reader sets no other limit."""


class Sweep(StrictModel):
    """The product of all axes over a base, in the order of their sorted paths, the last the fastest.

    Parameters
    ----------
    base : str or mapping
        Name of a preset, or a spec's document. No file: whoever reads one puts its document here.
    formats : sequence of str
        Names of formats; without any, the default format of each table.
    vary : mapping of str to list or Range
        Values by the dotted path of the field that takes them.
    """

    base: str | dict[str, Any]
    formats: tuple[str, ...] = ()
    vary: dict[str, Range | tuple[Any, ...]] = {}

    @classmethod
    def from_document(cls, document: Document, limit: int = MAX_TABLES) -> Self:
        """Return the sweep of a parsed document, of at most `limit` tables; raises `SpecError`.

        Every value of every axis is tried with the first of all others, so that most mistakes show here.
        """
        raise NotImplementedError

    @classmethod
    def of(cls, spec: Spec, formats: tuple[str, ...] = ()) -> Self:
        """Return the sweep of one spec alone."""
        raise NotImplementedError

    def to_document(self) -> Document:
        """Return the document that `from_document` reads."""
        raise NotImplementedError

    @property
    def id(self) -> str:
        """SHA-256, in hex, over all that decides the files; the order of its keys does not matter."""
        raise NotImplementedError

    def __len__(self) -> int:
        """Return the number of tables."""
        raise NotImplementedError

    def __getitem__(self, index: int) -> tuple[Work, ...]:
        """Return the works of a table, one a format; raises `SpecError` where its spec is wrong."""
        raise NotImplementedError
