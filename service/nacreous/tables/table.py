"""The table: named arrays over named axes, with units and provenance.

A plain value, because importing xarray costs more than computing a lookup texture; `Table.to_xarray` is there
for who asks for one.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import FileFormatError
from nacreous.tables.digest import array_bytes, digest
from nacreous.tables.sampling import Sampling
from nacreous.tables.spec import Spec
from nacreous.tables.spec_document import Syntax

if TYPE_CHECKING:
    import xarray

__all__ = ["Part", "Table", "Variable"]


_PREFIX = "nacreous:"
_OF_COPIES = (f"{_PREFIX}values", f"{_PREFIX}checksum")
"""Attributes that a dataset or a file has and a table has not."""


class Part(Enum):
    """A part of a table that can be computed on its own; a file format says which ones it holds."""

    SPECTRUM = "spectrum"
    """R_s, R_p, T_s, T_p (and psi, Delta) over (thickness_scale, cos_theta, wavelength_nm)."""
    COLOUR = "colour"
    """R_rgb, and T_rgb where the substrate transmits, over (thickness_scale, cos_theta, channel)."""


@dataclass(frozen=True, eq=False)
class Variable:
    """An array and what it means.

    Parameters
    ----------
    dims : tuple of str
        Name of each axis of `values`.
    values : array
    unit : str
        ``"1"`` for a ratio, ``"nm"``, ``"rad"``; empty for labels.
    meaning : str
        What a person reads beside it.
    """

    dims: tuple[str, ...]
    values: NDArray[Any]
    unit: str
    meaning: str


@dataclass(frozen=True, eq=False)
class Table:
    """A computed table.

    Parameters
    ----------
    spec : Spec
        What was asked for, complete.
    coords, variables : mapping of str to Variable
        Axes, each named as its dimension, and the quantities over them.
    provenance : mapping of str to str
        ``id``, ``version``, ``spec`` and ``certificate`` (both JSON), ``precision``, ``device``, ``kernels``.
    sampling : Sampling
        Where it is sampled.
    """

    spec: Spec
    coords: Mapping[str, Variable]
    variables: Mapping[str, Variable]
    provenance: Mapping[str, str]
    sampling: Sampling = Sampling.AXES

    @property
    def id(self) -> str:
        """SHA-256, in hex, over everything that decides the table's bytes."""
        return self.provenance["id"]

    @property
    def certificate(self) -> dict[str, Any]:
        """The errors measured between the texels, see `nacreous.tables.certificate`."""
        certificate: dict[str, Any] = json.loads(self.provenance["certificate"])
        return certificate

    def values(self, name: str) -> NDArray[Any]:
        """Array of the variable or axis of this name."""
        return (self.coords[name] if name in self.coords else self.variables[name]).values

    def to_xarray(self) -> "xarray.Dataset":
        """Return the table as a dataset; units and meanings are attributes, provenance is in ``.attrs``."""
        import xarray

        def entry(variable: Variable) -> tuple[tuple[str, ...], NDArray[Any], dict[str, str]]:
            return variable.dims, variable.values, {"units": variable.unit, "long_name": variable.meaning}

        provenance = {**self.provenance, "values": self._digest()}
        return xarray.Dataset(
            {name: entry(variable) for name, variable in self.variables.items()},
            {name: entry(variable) for name, variable in self.coords.items()},
            {f"{_PREFIX}{key}": value for key, value in provenance.items()},
        )

    def _digest(self) -> str:
        """Return what every change of the values, the axes or the provenance changes."""
        arrays = {**self.coords, **self.variables}
        dims = {name: ",".join(variable.dims) for name, variable in arrays.items()}
        values = array_bytes({name: variable.values for name, variable in arrays.items()})
        return digest({**self.provenance, "dims": json.dumps(dims, sort_keys=True)}, values)

    @classmethod
    def from_xarray(cls, dataset: "xarray.Dataset") -> Self:
        """Return the table that `to_xarray` made a dataset of.

        Raises
        ------
        FileFormatError
            The dataset is none of `to_xarray`'s, or has been changed since: what its provenance says is no
            longer true of it.
        """
        attributes = getattr(dataset, "attrs", {})
        provenance = {
            str(key).removeprefix(_PREFIX): str(value)
            for key, value in attributes.items()
            if str(key).startswith(_PREFIX) and key not in _OF_COPIES
        }
        if "spec" not in provenance:
            raise FileFormatError(
                f"expected a dataset as nacreous.tabulate returns it, got {_kind(dataset)}; "
                "write any other with xarray's own to_netcdf"
            )
        table = cls(
            Spec.from_text(provenance["spec"], Syntax.JSON),
            {str(name): _variable(array) for name, array in dataset.coords.items()},
            {str(name): _variable(array) for name, array in dataset.data_vars.items()},
            provenance,
        )
        if attributes.get(f"{_PREFIX}values") != table._digest():
            raise FileFormatError(
                "expected a dataset as it was computed, got one that has been changed since, which its id "
                "and its certificate no longer describe; write it with xarray's own to_netcdf"
            )
        return table


def _variable(array: "xarray.DataArray") -> Variable:
    dims = tuple(str(dim) for dim in array.dims)
    return Variable(
        dims, np.asarray(array.values), array.attrs.get("units", ""), array.attrs.get("long_name", "")
    )


def _kind(dataset: object) -> str:
    return "one without provenance" if hasattr(dataset, "attrs") else type(dataset).__name__
