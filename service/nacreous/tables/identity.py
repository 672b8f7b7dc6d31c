"""A table's id: a hash over everything that decides its bytes."""

import hashlib
import json

import numpy as np

from nacreous.opencl.sources import kernels_hash
from nacreous.optics.stack import sample_stack
from nacreous.tables.axes import wavelength_values_nm
from nacreous.tables.spec import Spec, canonical_json

__all__ = ["FORMAT_VERSION", "table_id"]

FORMAT_VERSION = 1
"""Raised whenever the meaning or the layout of a table changes."""


def table_id(spec: Spec) -> str:
    """SHA-256, in hex, over the format version, the spec, its n and k data, and the kernels.

    Two specs that differ in their labels alone have the same id; a material whose data changes has another.
    """
    sampled = sample_stack(spec.stack, wavelength_values_nm(spec.table.wavelength_nm))
    head = {"format": FORMAT_VERSION, "kernels": kernels_hash(), "spec": canonical_json(spec)}
    digest = hashlib.sha256(json.dumps(head, sort_keys=True).encode())
    digest.update(np.ascontiguousarray(sampled.index, "<c16").tobytes())
    return digest.hexdigest()
