"""Provenance as one text, for files that have no attributes."""

import json
from collections.abc import Mapping
from typing import Any

from numpy.typing import NDArray

from nacreous.formats.contents import CHECKSUM, PREFIX, Contents, checksum, labelled, provenance_of
from nacreous.tables.digest import array_bytes
from nacreous.tables.sampling import Sampling

__all__ = ["contents_of", "sealed"]


def sealed(arrays: Mapping[str, NDArray[Any]], provenance: Mapping[str, str]) -> str:
    """Return provenance and checksum of `arrays` as JSON in ASCII without line breaks."""
    labels = labelled(provenance)
    labels[CHECKSUM] = checksum(labels.items(), array_bytes(dict(arrays)))
    return json.dumps(labels)


def contents_of(arrays: Mapping[str, NDArray[Any]], text: str, sampling: Sampling) -> Contents:
    """Return the contents of a file whose provenance is `text`; raises `ValueError`."""
    labels = json.loads(text)
    if not isinstance(labels, dict):
        raise ValueError("its provenance is no object")  # noqa: TRY004 - a file is wrong, no argument
    ours = {key: str(value) for key, value in labels.items() if key.startswith(PREFIX)}
    found = checksum(ours.items(), array_bytes(dict(arrays)))
    return Contents(arrays, provenance_of(ours.items()), found, sampling)
