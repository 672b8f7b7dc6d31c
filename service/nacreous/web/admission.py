"""What no engine would compute, refused before one hears of it: too large a table, colours that nobody knows.

Engines count every buffer before they allocate it; here the table itself alone is counted, so that nothing is
refused that they would compute.
"""

from functools import lru_cache
from math import prod

from nacreous.engine.work import Work
from nacreous.errors import BudgetError
from nacreous.opencl.budget import byte_budget
from nacreous.optics.colour import colour_system
from nacreous.tables.axes import cos_theta_values, thickness_scale_values, wavelength_values_nm
from nacreous.tables.colour import has_colour
from nacreous.tables.sampling import Sampling
from nacreous.tables.spec import ColourSpec, Spec, bsdf_angles, roughness_values
from nacreous.tables.table import Part

__all__ = ["admit"]

_FLOAT_BYTES = 4
_COLOUR_CHANNELS = 3


def admit(work: Work) -> None:
    """Refuse what cannot be computed, whatever engine is asked.

    Raises
    ------
    BudgetError
        The numbers of the table alone are more than its budget.
    SpecError
        Nobody knows the illuminant or the observer.
    """
    _check_size(work)
    if has_colour(wavelength_values_nm(work.spec.table.wavelength_nm)):
        _check_colour(work.spec.colour)


def _check_size(work: Work) -> None:
    if work.target.sampling is not Sampling.AXES:
        return  # its grid is the format's own, and bounded
    texels = _texels(work.spec)
    numbers = _COLOUR_CHANNELS
    if Part.SPECTRUM in work.target.needs:
        numbers = wavelength_values_nm(work.spec.table.wavelength_nm).size
    needed = prod(texels) * numbers * _FLOAT_BYTES
    if needed > byte_budget():
        sizes = " x ".join(f"{size:,}" for size in (*texels, numbers))
        raise BudgetError(f"a table of {sizes} numbers", needed, byte_budget())


def _texels(spec: Spec) -> tuple[int, ...]:
    """Return the lengths of the axes, that of the wavelength aside."""
    table = spec.table
    if table.quantity == "bsdf":
        angles = bsdf_angles(spec)
        directions = (angles.theta_i, angles.theta_o, angles.phi, angles.phi_i)
        return (roughness_values(spec).size, *(axis.size for axis in directions))
    axes = (thickness_scale_values(table.thickness_scale).size, cos_theta_values(table.cos_theta).size)
    return axes if table.quantity == "fresnel" else (roughness_values(spec).size, *axes)


@lru_cache(maxsize=64)
def _check_colour(colour: ColourSpec) -> None:
    colour_system(colour.illuminant, colour.observer, colour.space)
