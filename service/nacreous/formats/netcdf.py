"""``netcdf``: the table as a NetCDF 4 dataset, for xarray, Panoply, MATLAB and everything that reads HDF5.

Names, units and meanings follow the CF conventions' attributes ``units`` and ``long_name``; provenance is in
global attributes. Arrays are compressed without loss.
"""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from nacreous.errors import FileFormatError, reason
from nacreous.formats.atomic import replacing
from nacreous.formats.contents import CHECKSUM, PREFIX, Contents, checksum, provenance_of
from nacreous.tables.digest import array_bytes
from nacreous.tables.table import Table

if TYPE_CHECKING:
    import xarray

__all__ = ["SUFFIX", "read", "write"]

SUFFIX = ".nc"


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write all of `table` and return the file; raises `FileFormatError`."""
    # In memory first: the HDF5 library ends the process where a disk is full.
    with replacing(path) as (temporary,):
        dataset = table.to_xarray()
        temporary.write_bytes(_encoded(dataset.assign_attrs({CHECKSUM: _checksum(dataset)})))
    return (path,)


def _encoded(dataset: "xarray.Dataset") -> memoryview:
    lossless = {"zlib": True, "shuffle": True, "complevel": 4}
    return dataset.to_netcdf(engine="h5netcdf", encoding={str(name): lossless for name in dataset.data_vars})


def read(path: Path) -> Contents:
    """Return all arrays and the provenance; raises `FileFormatError`."""
    dataset = _load(path)
    texts = [(str(key), value) for key, value in dataset.attrs.items()]
    return Contents(_arrays(dataset), provenance_of(texts), _checksum(dataset))


def _arrays(dataset: "xarray.Dataset") -> dict[str, NDArray[Any]]:
    return {str(name): array.to_numpy() for name, array in dataset.variables.items()}


def _checksum(dataset: "xarray.Dataset") -> str:
    """Return the checksum, which is over dimensions, units and meanings as well."""
    meanings = {str(name): [array.dims, array.attrs] for name, array in dataset.variables.items()}
    facts = {**dataset.attrs, f"{PREFIX}meanings": json.dumps(meanings, sort_keys=True, default=str)}
    return checksum(((str(key), value) for key, value in facts.items()), array_bytes(_arrays(dataset)))


def _load(path: Path) -> "xarray.Dataset":
    import xarray

    try:
        return xarray.load_dataset(path, engine="h5netcdf")
    except (OSError, ValueError, KeyError, RuntimeError, TypeError) as error:
        raise FileFormatError(
            f"expected a NetCDF 4 file, got one that cannot be read: {reason(error)}"
        ) from error
