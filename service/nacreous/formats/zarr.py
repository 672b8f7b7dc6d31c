"""``zarr``: the table as a Zarr 3 group, for xarray, dask and everything that reads Zarr.

Names, units and meanings are those of ``netcdf``, provenance is in the group's attributes, and arrays are
compressed without loss. The group lies in one uncompressed zip archive, the `ZipStore` of Zarr::

    xarray.open_zarr(zarr.storage.ZipStore("film.zarr"), consolidated=False)

``unzip -d film film.zarr`` makes the folder of it that an object store or a program in another language
wants. The archive, and no folder, is what Nacreous writes for three reasons. A folder that is there cannot be
replaced in one step: `rename` refuses a target that is not empty (POSIX.1-2017), so that whoever opens it in
between finds nothing, or old chunks beside new ones. One file has one SHA-256, which is what ``verify`` and
``tabulate --json`` state. And it can be sent, stored and deleted as every other file of Nacreous.
"""

import zipfile
import zlib
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from nacreous.errors import FileFormatError, reason
from nacreous.formats.atomic import replacing
from nacreous.formats.contents import CHECKSUM, Contents
from nacreous.formats.dataset import dataset_checksum, dataset_contents
from nacreous.tables.table import Table

if TYPE_CHECKING:
    import xarray
    from zarr.abc.buffer import Buffer

__all__ = ["SUFFIX", "read", "write"]

SUFFIX = ".zarr"

_EPOCH = (1980, 1, 1, 0, 0, 0)
"""The earliest time of a zip archive (APPNOTE 4.4.6): the same table gives the same bytes at any time."""


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write all of `table` and return the file; raises `FileFormatError`."""
    with replacing(path) as (temporary,):
        dataset = table.to_xarray()
        temporary.write_bytes(_archive(dataset.assign_attrs({CHECKSUM: dataset_checksum(dataset)})))
    return (path,)


def _archive(dataset: "xarray.Dataset") -> bytes:
    archive = BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_STORED) as file:
        for key, value in sorted(_entries(dataset).items()):
            file.writestr(zipfile.ZipInfo(key, _EPOCH), value)
    return archive.getvalue()


def _entries(dataset: "xarray.Dataset") -> dict[str, bytes]:
    """Return the keys and values of the group; `ZipStore` would write the time of day into its archive."""
    from zarr.storage import MemoryStore

    entries: dict[str, Buffer] = {}
    _with_variable_text(dataset).to_zarr(MemoryStore(entries), zarr_format=3, consolidated=False)
    return {key: value.to_bytes() for key, value in entries.items()}


def _with_variable_text(dataset: "xarray.Dataset") -> "xarray.Dataset":
    """Give text a type that Zarr 3 specifies: it has none for NumPy's text of fixed width."""
    from numpy.dtypes import StringDType

    coords = dataset.coords.items()
    texts = {name: array.astype(StringDType()) for name, array in coords if array.dtype.kind == "U"}
    return dataset.assign_coords(texts)


def read(path: Path) -> Contents:
    """Return all arrays and the provenance; raises `FileFormatError`."""
    return dataset_contents(_load(path))


def _load(path: Path) -> "xarray.Dataset":
    import xarray
    from zarr.storage import MemoryStore

    try:
        store = MemoryStore(_unpacked(path))
        group: xarray.Dataset = xarray.open_zarr(store, chunks=None, consolidated=False)
        return group.load()
    except (OSError, ValueError, KeyError, RuntimeError, TypeError, zipfile.BadZipFile, zlib.error) as error:
        raise FileFormatError(
            f"expected a Zarr group in a zip archive, got one that cannot be read: {reason(error)}"
        ) from error


def _unpacked(path: Path) -> "dict[str, Buffer]":
    """Return the keys and values of the group; `ZipStore` does not close what is no archive."""
    from zarr.buffer.cpu import Buffer as Memory

    with zipfile.ZipFile(path) as file:
        return {name: Memory.from_bytes(file.read(name)) for name in file.namelist()}
