"""The section ``[table]`` of a spec: the quantity, and the axes that its table has."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Literal, Self

from pydantic import model_validator

from nacreous.optics.value import StrictModel, refusal
from nacreous.tables.axes import (
    AzimuthAxis,
    CosThetaAxis,
    PolarAngleAxis,
    Range,
    RoughnessAxis,
    ThicknessScaleAxis,
    WavelengthAxis,
    thickness_scale_values,
)

__all__ = ["Quantity", "TableSpec"]

Quantity = Literal["fresnel", "albedo", "bsdf"]

_AXES_OF_SOME: Mapping[str, tuple[Quantity, ...]] = MappingProxyType(
    {
        "roughness": ("albedo", "bsdf"),
        "theta_i": ("bsdf",),
        "theta_o": ("bsdf",),
        "phi": ("bsdf",),
        "phi_i": ("bsdf",),
    }
)
"""Axes that not every quantity has, and the quantities that have them."""


class TableSpec(StrictModel):
    """What is tabulated, over which axes.

    Parameters
    ----------
    quantity : str
        ``"fresnel"``: R and T of the film for s and p. ``"albedo"``: the share of the light that the rough
        surface reflects and transmits, by direction. ``"bsdf"``: how it scatters from each direction to each.
    wavelength_nm : list or range
        Vacuum wavelengths, 100 to 100,000 nm.
    cos_theta : count, list or range
        Cosines of the angle of incidence, 0 to 1; a count spaces them equally over [0, 1]. A bsdf has
        `theta_i` in its place.
    thickness_scale : 1, list or range
        Factors on every layer's thickness; 1 for a bsdf.
    roughness : list or range, optional
        albedo and bsdf: sqrt(alpha_x alpha_y), 0.001 to 1; the surface keeps its ratio of both. Without it,
        the surface's own.
    theta_i, theta_o : count, list or range, optional
        bsdf: angles of incoming and outgoing light from the normal, each on its own side of the surface, 0 to
        1.5707 rad; 16 and 32 where left out. A count spaces them equally over 0 to 89 degrees.
    phi : count, list or range, optional
        bsdf: phi_o - phi_i, -pi to pi. A count spaces it equally over 0 to pi, 19 where left out; of an
        anisotropic surface over -pi to pi, 37 where left out.
    phi_i : count, list or range, optional
        bsdf of an anisotropic surface: azimuth of the incoming light, -pi to pi; 5 where left out. A count
        spaces it equally over 0 to pi / 2: the other quarters are its mirror images.
    transmission : str
        albedo and bsdf: ``"keep"``, or ``"discard"`` to take what is transmitted as lost, for files and
        renderers that know reflected light alone.
    ellipsometry : bool
        fresnel: whether the table holds psi and Delta as well.
    """

    quantity: Quantity = "fresnel"
    wavelength_nm: WavelengthAxis = Range(start=350.0, stop=750.0, step=5.0)
    cos_theta: CosThetaAxis = 64
    thickness_scale: ThicknessScaleAxis = 1
    roughness: RoughnessAxis = None
    theta_i: PolarAngleAxis = None
    theta_o: PolarAngleAxis = None
    phi: AzimuthAxis = None
    phi_i: AzimuthAxis = None
    transmission: Literal["keep", "discard"] = "keep"
    ellipsometry: bool = False

    @model_validator(mode="after")
    def _check(self) -> Self:
        _check_axes(self)
        if self.quantity == "bsdf" and not isinstance(self.thickness_scale, int):
            got = f"{thickness_scale_values(self.thickness_scale).size} factors"
            remedy = "make one table for each thickness"
            raise refusal("1 for a bsdf, which has one thickness", got, remedy, field="thickness_scale")
        if self.transmission == "discard" and self.quantity == "fresnel":
            expected = '"keep" for a film, whose T belongs to it'
            remedy = 'leave transmission out, or take quantity = "bsdf" or "albedo"'
            raise refusal(expected, '"discard"', remedy, field="transmission")
        if self.ellipsometry and self.quantity != "fresnel":
            expected = f"false: psi and Delta are of a smooth film, and the quantity is {self.quantity}"
            remedy = 'leave ellipsometry out, or take quantity = "fresnel"'
            raise refusal(expected, "true", remedy, field="ellipsometry")
        return self


def _check_axes(table: TableSpec) -> None:
    """Refuse an axis that the quantity does not have, instead of leaving it unread."""
    for axis, quantities in _AXES_OF_SOME.items():
        if getattr(table, axis) is not None and table.quantity not in quantities:
            able = " or ".join(f'"{quantity}"' for quantity in quantities)
            remedy = f"leave it out, or take quantity = {able}"
            raise refusal(f"no such axis: the quantity is {table.quantity}", "one", remedy, field=axis)
