"""The tables of a rough surface that a preview shows: its lobes, and its albedo over roughness."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.opencl.tiles import Observer
from nacreous.optics.surface import MAX_ALPHA, MIN_ALPHA, Surface, alphas_at, exponent_of
from nacreous.tables.spec import Spec, roughness_values, surface_of
from nacreous.tables.table import Part, Table
from nacreous.tables.tabulate import tabulate_table

__all__ = ["LOBE_ANGLES", "STRIP_ANGLES", "RoughTables", "is_rough", "rough_tables", "surface_line"]

FloatArray = NDArray[np.float64]
SpecOver = Callable[..., Spec]
"""The spec of a preview over other axes."""

LOBE_ANGLES = (0.0, 30.0, 60.0)
"""Degrees of incidence at which a lobe is drawn."""
STRIP_ANGLES = np.linspace(89.0, 0.0, 90)
"""Degrees of the roughness strip's columns, grazing first; their cosines ascend."""

_OUTGOING = {"start": 0.0, "stop": math.radians(89.6), "count": 449}
"""Steps of 0.2 degrees, which the angles of incidence are multiples of: a narrow lobe has its peak."""
_STRIP = (0.02, 1.0)
_STRIP_COUNT = 50
_ASSUMED_ROUGHNESS = 0.2
"""Where neither the surface nor the table says one."""


@dataclass(frozen=True, eq=False)
class RoughTables:
    """What a preview draws of a rough surface.

    Parameters
    ----------
    surface : Surface
    roughness : float
        At which the lobes are.
    lobes : Table
        f_r, and f_t where the substrate transmits, at `LOBE_ANGLES`, in the plane of incidence: phi 0 and pi.
    strip : Table
        Albedos over roughness and `STRIP_ANGLES`.
    """

    surface: Surface
    roughness: float
    lobes: Table
    strip: Table


def is_rough(spec: Spec) -> bool:
    """Tell whether a spec speaks of a surface at all."""
    return spec.surface is not None or spec.table.quantity != "fresnel"


def rough_tables(
    spec: Spec, over: SpecOver, observers: tuple[Observer | None, Observer | None]
) -> RoughTables:
    """Compute the tables of a rough surface; raises what `tabulate_table` raises.

    Parameters
    ----------
    spec : Spec
        The film as it was asked for.
    over : callable
        Returns the spec of a quantity over other axes.
    observers : pair of callables
        Told how far the lobes and the strip are.
    """
    roughness = _lobe_roughness(spec)
    lobes = over(
        "bsdf",
        roughness=[roughness],
        theta_i=np.deg2rad(LOBE_ANGLES).tolist(),
        theta_o=_OUTGOING,
        phi=[0.0, math.pi],
        **({"phi_i": [0.0]} if surface_of(spec).anisotropic else {}),
    )
    return RoughTables(
        surface_of(spec),
        roughness,
        tabulate_table(lobes, {Part.COLOUR}, observer=observers[0]),
        _strip(spec, over, observers[1]),
    )


def _lobe_roughness(spec: Spec) -> float:
    """Return the surface's own roughness, or the middle one of the table's."""
    own = surface_of(spec).roughness
    known = roughness_values(spec) if own is None else np.array([own])
    return float(known[known.size // 2]) if known.size else _ASSUMED_ROUGHNESS


def _strip(spec: Spec, over: SpecOver, observer: Observer | None) -> Table:
    """Tabulate albedos over all roughnesses, or over the lobes' where weights allow no others."""
    cosines = np.cos(np.deg2rad(STRIP_ANGLES)).tolist()
    try:
        wide = over("albedo", roughness=_strip_roughness(spec), cos_theta=cosines)
        return tabulate_table(wide, {Part.COLOUR}, observer=observer)
    except SpecError as error:
        if error.field != "surface":
            raise
        own = over("albedo", roughness=[_lobe_roughness(spec)], cos_theta=cosines)
        return tabulate_table(own, {Part.COLOUR}, observer=observer)


def _strip_roughness(spec: Spec) -> list[float]:
    """Return as much of the strip as keeps both alphas within bounds."""
    stretch = math.sqrt(surface_of(spec).ratio)
    most = max(stretch, 1 / stretch)
    first, last = max(_STRIP[0], MIN_ALPHA * most), min(_STRIP[1], MAX_ALPHA / most)
    return np.linspace(first, last, _STRIP_COUNT).tolist() if first < last else [_lobe_roughness(spec)]


def surface_line(tables: RoughTables) -> str:
    """Return distribution, roughness and masking of the lobes, on one line."""
    surface = tables.surface
    alphas = alphas_at(surface, np.array([tables.roughness]))[0]
    along = alphas if surface.anisotropic else alphas[:1]
    alpha = " x ".join(f"{value:.3g}" for value in along)
    exponent = " x ".join(f"{exponent_of(value):.4g}" for value in along)
    terms = [
        surface.distribution,
        f"alpha {alpha} (exponent {exponent})",
        f"{surface.masking} masking",
        *(
            [f"diffuse {surface.diffuse_weight * surface.diffuse_reflectance:g}"]
            if surface.diffuse_weight
            else []
        ),
        *([surface.multiple_scattering] if surface.multiple_scattering != "none" else []),
    ]
    return ", ".join(terms)
