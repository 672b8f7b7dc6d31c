"""What is asked of an engine, and what comes of it: the files of one format of one spec."""

import shutil
import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS, Format, check_holds, parts_of
from nacreous.tables.identity import table_id
from nacreous.tables.spec import Spec
from nacreous.tables.tabulate import Observer, tabulate_table

__all__ = ["File", "Product", "Work", "compute"]


_MEMORY = Path("/dev/shm")  # noqa: S108 - TemporaryDirectory makes a folder that is this user's alone
_MOST_BYTES = 2**30
"""More than the files of any format take together."""


@dataclass(frozen=True)
class Work:
    """One format of one spec: the unit that is computed, waited for together, and stored.

    Parameters
    ----------
    spec : Spec
    format : FormatName
    stem : str, optional
        File name without its suffix, which a MaterialX document has inside: it names the texture beside it.
        The id of the table, without one.

    Raises
    ------
    SpecError
        The format cannot hold the table of the spec, or a material cannot be used.
    """

    spec: Spec
    format: FormatName
    stem: str = ""

    def __post_init__(self) -> None:
        check_holds(self.target, self.spec)

    @property
    def target(self) -> Format:
        """The format itself."""
        return FORMATS[self.format]

    @cached_property
    def id(self) -> str:
        """Id of the table."""
        return table_id(self.spec)

    @property
    def name(self) -> str:
        """File name without its suffix."""
        return self.stem or self.id


@dataclass(frozen=True)
class File:
    """A finished file: what its name ends in, such as ``".transmission.exr"``, and its bytes."""

    suffix: str
    payload: bytes


@dataclass(frozen=True)
class Product:
    """What came of a work.

    Parameters
    ----------
    id : str
        Id of the table.
    files : tuple of File
        The file of the format itself, and those that belong to it.
    certificate : mapping
        The errors of the table, see `nacreous.tables.certificate`.
    seconds : float
        What the computation and the writing took.
    """

    id: str
    files: tuple[File, ...]
    certificate: Mapping[str, Any]
    seconds: float


def compute(work: Work, observer: Observer | None = None) -> Product:
    """Do the work in this process, on its OpenCL device.

    The files are those that `nacreous.write` makes of the same spec, byte for byte.

    Raises
    ------
    SpecError, BudgetError, DeviceError, NumericalError, FileFormatError
    """
    began = time.perf_counter()
    if observer is not None:
        observer(0.0)  # it has begun
    table = tabulate_table(
        work.spec, parts_of([work.target], work.spec), sampling=work.target.sampling, observer=observer
    )
    with tempfile.TemporaryDirectory(prefix="nacreous-", dir=_scratch()) as folder:
        name = work.stem or table.id
        paths = work.target.write(table, Path(folder, f"{name}{work.target.suffix}"))
        files = tuple(File(path.name.removeprefix(name), path.read_bytes()) for path in paths)
    return Product(table.id, files, table.certificate, time.perf_counter() - began)


def _scratch() -> Path | None:
    """Return where files are made that are read at once and gone: in memory, where it has room for them."""
    try:
        roomy = shutil.disk_usage(_MEMORY).free > _MOST_BYTES
    except OSError:
        return None
    return _MEMORY if roomy else None
