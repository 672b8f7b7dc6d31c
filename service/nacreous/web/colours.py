"""Whether a spec's colours can be computed at all, before an engine hears of it."""

from functools import lru_cache

from nacreous.optics.colour import colour_system
from nacreous.tables.axes import wavelength_values_nm
from nacreous.tables.colour import has_colour
from nacreous.tables.spec import ColourSpec, Spec

__all__ = ["check_colour"]


def check_colour(spec: Spec) -> None:
    """Raise `SpecError` for an illuminant or an observer that nobody knows."""
    if has_colour(wavelength_values_nm(spec.table.wavelength_nm)):
        _check(spec.colour)


@lru_cache(maxsize=64)
def _check(colour: ColourSpec) -> None:
    colour_system(colour.illuminant, colour.observer, colour.space)
