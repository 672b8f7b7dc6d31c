"""The axes that a spec asks for, by the names that its table and every file give them."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

from nacreous.formats.atlas import Axis
from nacreous.tables.axes import cos_theta_values, thickness_scale_values, wavelength_values_nm
from nacreous.tables.spec import Spec, bsdf_angles, roughness_values, surface_of

__all__ = ["AXES", "spec_axes"]

AXES = frozenset(
    {
        "roughness",
        "thickness_scale",
        "cos_theta",
        "phi_i",
        "theta_i",
        "theta_o",
        "phi",
        "wavelength_nm",
        "channel",
        "theta_h",
        "theta_d",
        "phi_d",
        "wvls",
    }
)
"""Arrays of a file that are no quantities."""


def _fresnel(spec: Spec) -> tuple[Axis, ...]:
    table = spec.table
    return (
        Axis("thickness_scale", "1", thickness_scale_values(table.thickness_scale)),
        Axis("cos_theta", "1", cos_theta_values(table.cos_theta)),
        Axis("wavelength_nm", "nm", wavelength_values_nm(table.wavelength_nm)),
    )


def _albedo(spec: Spec) -> tuple[Axis, ...]:
    return (Axis("roughness", "1", roughness_values(spec)), *_fresnel(spec))


def _bsdf(spec: Spec) -> tuple[Axis, ...]:
    at = bsdf_angles(spec)
    phi_i = (Axis("phi_i", "rad", at.phi_i),) if surface_of(spec).anisotropic else ()
    return (
        Axis("roughness", "1", roughness_values(spec)),
        *phi_i,
        Axis("theta_i", "rad", at.theta_i),
        Axis("theta_o", "rad", at.theta_o),
        Axis("phi", "rad", at.phi),
        Axis("wavelength_nm", "nm", wavelength_values_nm(spec.table.wavelength_nm)),
    )


_OF_QUANTITIES: Mapping[str, Callable[[Spec], tuple[Axis, ...]]] = MappingProxyType(
    {"fresnel": _fresnel, "albedo": _albedo, "bsdf": _bsdf}
)


def spec_axes(spec: Spec) -> dict[str, Axis]:
    """Return the axes of the table that a spec asks for, by name and in their order."""
    return {axis.name: axis for axis in _OF_QUANTITIES[spec.table.quantity](spec)}
