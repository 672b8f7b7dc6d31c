"""``npz``: every array of a table for NumPy, exact and quick to load.

`numpy.load` gives axes and quantities by name (``R_s``, ``cos_theta``, …). Text is in arrays of no dimension:
``nacreous:id``, ``nacreous:spec`` and the rest of the provenance, and ``nacreous:dims``, a JSON object with
the axes of each array. The arrays are not compressed, and none is pickled.
"""

import json
import zipfile
from pathlib import Path

import numpy as np

from nacreous.errors import FileFormatError, reason
from nacreous.formats.atomic import replacing
from nacreous.formats.contents import CHECKSUM, PREFIX, Contents, checksum, labelled, provenance_of
from nacreous.tables.digest import array_bytes
from nacreous.tables.table import Table

__all__ = ["SUFFIX", "read", "write"]

SUFFIX = ".npz"


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write all of `table` and return the file; raises `FileFormatError`."""
    variables = {**table.coords, **table.variables}
    arrays = {name: variable.values for name, variable in variables.items()}
    dims = json.dumps({name: variable.dims for name, variable in variables.items()})
    texts = labelled({**table.provenance, "dims": dims})
    texts[CHECKSUM] = checksum(texts.items(), array_bytes(arrays))
    with replacing(path) as (temporary,), temporary.open("xb") as file:
        np.savez(file, allow_pickle=False, **arrays, **{name: np.array(text) for name, text in texts.items()})
    return (path,)


def read(path: Path) -> Contents:
    """Return all arrays and the provenance; raises `FileFormatError`."""
    try:
        # Opened here: `numpy.load` forgets to close what turns out to be no archive.
        with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
            stored = {name: archive[name] for name in archive.files}
    except (OSError, ValueError, EOFError, KeyError, TypeError, AttributeError, zipfile.BadZipFile) as error:
        raise FileFormatError(
            f"expected an npz archive, got one that cannot be read: {reason(error)}"
        ) from error
    arrays = {name: array for name, array in stored.items() if not name.startswith(PREFIX)}
    texts = [(name, array) for name, array in stored.items() if name.startswith(PREFIX)]
    return Contents(arrays, provenance_of(texts), checksum(texts, array_bytes(arrays)))
