"""The tables that a preview shows: those of the spec, over axes that make a picture."""

from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.cli.preview_surface import RoughTables, is_rough, rough_tables
from nacreous.opencl.tiles import Observer, step_of
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
    rough : RoughTables, optional
        Of a spec that speaks of a surface.
    """

    spec: Spec
    swatch: Table
    spectrum: Table
    rough: RoughTables | None = None

    @property
    def angles(self) -> NDArray[np.float64]:
        """Degrees of the swatch's columns."""
        return _ANGLES


def preview_tables(spec: Spec, observer: Observer | None = None) -> PreviewTables:
    """Compute the tables of a preview; raises what `tabulate_table` raises."""
    steps = 3 if is_rough(spec) else 1
    first, second, third = (step_of(observer, done, steps) for done in range(3))
    swatch = tabulate_table(_swatch_spec(spec), {Part.COLOUR}, observer=first)
    spectrum = tabulate_table(_spectrum_spec(spec), {Part.SPECTRUM})
    rough = rough_tables(spec, partial(_over, spec), (second, third)) if is_rough(spec) else None
    return PreviewTables(spec, swatch, spectrum, rough)


def _swatch_spec(spec: Spec) -> Spec:
    scales = thickness_scale_values(spec.table.thickness_scale)
    first, last = (scales[0], scales[-1]) if len(scales) > 1 else (1e-3, 2.0)
    thickness = {"start": float(first), "stop": float(last), "count": _THICKNESSES}
    return _over(spec, "fresnel", thickness_scale=thickness, cos_theta=_cosines(_ANGLES))


def _spectrum_spec(spec: Spec) -> Spec:
    return _over(spec, "fresnel", cos_theta=_cosines(SPECTRUM_ANGLES))


def _cosines(degrees: Any) -> list[float]:  # noqa: ANN401 - anything that numpy takes
    return np.cos(np.deg2rad(degrees)).tolist()  # type: ignore[no-any-return]


def _over(spec: Spec, quantity: str, **axes: object) -> Spec:
    """Return the spec of a quantity over other axes, on the grid as it is, with colours for a screen."""
    fields = spec.model_dump(mode="json")
    fields["table"] = {"quantity": quantity, "wavelength_nm": fields["table"]["wavelength_nm"], **axes}
    fields["colour"] |= {"space": "Rec.709"}
    fields["accuracy"] |= {"delta_e": None}
    return Spec.from_document(fields)
