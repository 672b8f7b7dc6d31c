"""The tables that a preview shows: those of the spec, over axes that make a picture."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.tables.axes import thickness_scale_values
from nacreous.tables.spec import Spec
from nacreous.tables.table import Part, Table
from nacreous.tables.tabulate import tabulate_table

__all__ = ["SPECTRUM_ANGLES", "PreviewTables", "preview_tables"]

SPECTRUM_ANGLES = (75.0, 60.0, 30.0, 0.0)
"""Degrees at which a spectrum is drawn; their cosines ascend."""

_ANGLES = np.linspace(89.0, 0.0, 179)
"""Degrees of the swatch's columns, grazing first; their cosines ascend."""

_THICKNESSES = 401


@dataclass(frozen=True, eq=False)
class PreviewTables:
    """What a preview draws.

    Parameters
    ----------
    spec : Spec
        The film as it was asked for.
    swatch : Table
        Colours over (thickness, angle) in Rec.709.
    spectrum : Table
        R and T at `SPECTRUM_ANGLES`, at scale 1.
    """

    spec: Spec
    swatch: Table
    spectrum: Table

    @property
    def angles(self) -> NDArray[np.float64]:
        """Degrees of the swatch's columns."""
        return _ANGLES


def preview_tables(spec: Spec, observer: Callable[[float], None] | None = None) -> PreviewTables:
    """Compute the tables of a preview; raises what `tabulate_table` raises."""
    swatch = tabulate_table(_swatch_spec(spec), {Part.COLOUR}, observer=observer)
    spectrum = tabulate_table(_spectrum_spec(spec), {Part.SPECTRUM})
    return PreviewTables(spec, swatch, spectrum)


def _swatch_spec(spec: Spec) -> Spec:
    scales = thickness_scale_values(spec.table.thickness_scale)
    first, last = (scales[0], scales[-1]) if len(scales) > 1 else (1e-3, 2.0)
    thickness = {"start": float(first), "stop": float(last), "count": _THICKNESSES}
    return _changed(spec, thickness_scale=thickness, cos_theta=_cosines(_ANGLES))


def _spectrum_spec(spec: Spec) -> Spec:
    return _changed(spec, thickness_scale=1, cos_theta=_cosines(SPECTRUM_ANGLES))


def _cosines(degrees: Any) -> list[float]:  # noqa: ANN401 - anything that numpy takes
    return np.cos(np.deg2rad(degrees)).tolist()  # type: ignore[no-any-return]


def _changed(spec: Spec, **axes: object) -> Spec:
    """Return `spec` over other axes, on the grid as it is, with colours for a screen."""
    fields = spec.model_dump(mode="json")
    fields["table"] |= axes
    fields["colour"] |= {"space": "Rec.709"}
    fields["accuracy"] |= {"delta_e": None}
    return Spec.from_document(fields)
