"""Materials of other programs that are a film on facets and nothing else."""

from nacreous.errors import SpecError
from nacreous.tables.spec import Spec, surface_of

__all__ = ["check_specular"]


def check_specular(spec: Spec, format_name: str) -> None:
    """Refuse a surface with a diffuse term or a weight: the material would be another one without a word."""
    surface = surface_of(spec)
    if surface.diffuse_weight * surface.diffuse_reflectance > 0 or surface.specular_weight != 1:
        expected = (
            f"specular_weight 1 and no diffuse term for {format_name}, whose material is the film alone"
        )
        got = f"specular_weight {surface.specular_weight:g}, diffuse_weight {surface.diffuse_weight:g}"
        raise SpecError(
            "surface", expected, got, "leave them out, and add a diffuse material in the renderer"
        )
