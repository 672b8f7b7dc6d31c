"""The tables of a rough surface that a preview shows: its lobes, and its albedo over roughness."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.opencl.tiles import Observer
from nacreous.optics.stack import sample_stack
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
STRIP_ANGLES = np.linspace(89.0, 0.0, 24)
"""Degrees of the roughness strip's columns, grazing first; their cosines ascend."""

_WIDE = np.deg2rad(np.linspace(0.0, 89.5, 180))
_AROUND_PEAK = np.linspace(-6, 6, 49)
"""Where a lobe is looked at besides, in units of its roughness."""
_NM = 550.0
"""Vacuum wavelength whose refraction says where a lobe of transmission is."""
_STRIP = (0.02, 1.0)
_STRIP_COUNT = 12
_OF_EXPONENTS = frozenset({"ashikhmin-shirley", "blinn", "phong"})
"""Distributions that are powers of a cosine."""
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

    @property
    def transmits(self) -> bool:
        """Whether light goes through, so that there are lobes below the surface."""
        return "f_t_rgb" in self.lobes.variables


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
        theta_o=_outgoing(spec, roughness).tolist(),
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


def _outgoing(spec: Spec, roughness: float) -> FloatArray:
    """Return angles of outgoing light, (O,): all over, and close together where narrow lobes peak."""
    alpha_x = alphas_at(surface_of(spec), np.array([roughness]))[0, 0]
    index = sample_stack(spec.stack, np.array([_NM])).index.real[:, 0]  # incident medium first
    theta_i = np.deg2rad(LOBE_ANGLES)
    refracted = np.arcsin(np.minimum(np.sin(theta_i) * index[0] / index[-1], 1))
    peaks = np.concatenate([theta_i, refracted])
    around = (peaks[:, None] + alpha_x * _AROUND_PEAK).ravel()
    return np.unique(np.clip(np.concatenate([_WIDE, peaks, around]), 0, _WIDE[-1]).round(7))


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
    diffuse = surface.diffuse_weight * surface.diffuse_reflectance
    terms = {
        surface.distribution: True,
        _roughness_term(tables): True,
        f"{surface.masking} masking": True,
        f"diffuse {diffuse:g}": diffuse > 0,
        surface.multiple_scattering: surface.multiple_scattering != "none",
        "in the plane of x": surface.anisotropic,
    }
    return ", ".join(term for term, applies in terms.items() if applies)


def _roughness_term(tables: RoughTables) -> str:
    alphas = alphas_at(tables.surface, np.array([tables.roughness]))[0]
    along = alphas if tables.surface.anisotropic else alphas[:1]
    alpha = "alpha " + " x ".join(f"{value:.3g}" for value in along)
    if tables.surface.distribution not in _OF_EXPONENTS:
        return alpha
    return f"{alpha} (exponent {' x '.join(f'{exponent_of(value):.4g}' for value in along)})"
