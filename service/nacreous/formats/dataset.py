"""What the formats of xarray have in common: the arrays of a dataset, its provenance and its checksum."""

import json
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from nacreous.formats.contents import PREFIX, Contents, checksum, provenance_of
from nacreous.tables.digest import array_bytes

if TYPE_CHECKING:
    import xarray

__all__ = ["dataset_checksum", "dataset_contents"]


def dataset_contents(dataset: "xarray.Dataset") -> Contents:
    """Return all arrays and the provenance of a dataset that was read."""
    texts = [(str(key), value) for key, value in dataset.attrs.items()]
    return Contents(_arrays(dataset), provenance_of(texts), dataset_checksum(dataset))


def dataset_checksum(dataset: "xarray.Dataset") -> str:
    """Return the checksum, which is over dimensions, units and meanings as well."""
    meanings = {str(name): [array.dims, array.attrs] for name, array in dataset.variables.items()}
    facts = {**dataset.attrs, f"{PREFIX}meanings": json.dumps(meanings, sort_keys=True, default=str)}
    return checksum(((str(key), value) for key, value in facts.items()), array_bytes(_arrays(dataset)))


def _arrays(dataset: "xarray.Dataset") -> dict[str, NDArray[Any]]:
    return {str(name): array.to_numpy() for name, array in dataset.variables.items()}
