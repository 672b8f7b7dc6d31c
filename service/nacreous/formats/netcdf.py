"""``netcdf``: the table as a NetCDF 4 dataset, for xarray, Panoply, MATLAB and everything that reads HDF5.

Names, units and meanings follow the CF conventions' attributes ``units`` and ``long_name``; provenance is in
global attributes. Arrays are compressed without loss.
"""

from pathlib import Path
from typing import TYPE_CHECKING

from nacreous.errors import FileFormatError, reason
from nacreous.formats.atomic import replacing
from nacreous.formats.contents import CHECKSUM, Contents
from nacreous.formats.dataset import dataset_checksum, dataset_contents
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
        temporary.write_bytes(_encoded(dataset.assign_attrs({CHECKSUM: dataset_checksum(dataset)})))
    return (path,)


def _encoded(dataset: "xarray.Dataset") -> memoryview:
    lossless = {"zlib": True, "shuffle": True, "complevel": 4}
    return dataset.to_netcdf(engine="h5netcdf", encoding={str(name): lossless for name in dataset.data_vars})


def read(path: Path) -> Contents:
    """Return all arrays and the provenance; raises `FileFormatError`."""
    return dataset_contents(_load(path))


def _load(path: Path) -> "xarray.Dataset":
    import xarray

    try:
        return xarray.load_dataset(path, engine="h5netcdf")
    except (OSError, ValueError, KeyError, RuntimeError, TypeError) as error:
        raise FileFormatError(
            f"expected a NetCDF 4 file, got one that cannot be read: {reason(error)}"
        ) from error
