"""``netcdf``: the table as a NetCDF 4 dataset, for xarray, Panoply, MATLAB and everything that reads HDF5.

Names, units and meanings follow the CF conventions' attributes ``units`` and ``long_name``; provenance is in
global attributes. Arrays are compressed without loss.
"""

from pathlib import Path
from typing import TYPE_CHECKING

from nacreous.errors import FileFormatError
from nacreous.formats.atomic import replacing
from nacreous.formats.contents import Contents, provenance_of
from nacreous.tables.table import Table

if TYPE_CHECKING:
    import xarray

__all__ = ["SUFFIX", "read", "write"]

SUFFIX = ".nc"


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write all of `table` and return the file; raises `FileFormatError`."""
    # In memory first: the HDF5 library ends the process where a disk is full.
    with replacing(path) as (temporary,):
        temporary.write_bytes(_encoded(table.to_xarray()))
    return (path,)


def _encoded(dataset: "xarray.Dataset") -> memoryview:
    lossless = {"zlib": True, "shuffle": True, "complevel": 4}
    return dataset.to_netcdf(engine="h5netcdf", encoding={str(name): lossless for name in dataset.data_vars})


def read(path: Path) -> Contents:
    """Return all arrays and the provenance; raises `FileFormatError`."""
    dataset = _load(path)
    arrays = {str(name): array.to_numpy() for name, array in dataset.variables.items()}
    return Contents(arrays, provenance_of((str(key), value) for key, value in dataset.attrs.items()))


def _load(path: Path) -> "xarray.Dataset":
    import xarray

    try:
        return xarray.load_dataset(path, engine="h5netcdf")
    except (OSError, ValueError, KeyError, RuntimeError, TypeError) as error:
        raise FileFormatError(f"expected a NetCDF 4 file, got one that cannot be read: {error}") from error
