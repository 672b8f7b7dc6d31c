"""Where a table is sampled: along the axes of its spec, or where the readers of a file want it."""

from enum import Enum

__all__ = ["Sampling"]


class Sampling(Enum):
    """The points of a table; a file format says which ones its readers know."""

    AXES = "axes"
    """The axes that the spec names, of any quantity."""
    RGL_SPECTRA = "rgl-spectra"
    """A bsdf on the warped square of Dupuy and Jakob 2018, at the spec's wavelengths."""
    RGL_COLOURS = "rgl-colours"
    """The same in linear colours."""
    MERL = "merl"
    """Linear colours in the bins of the MERL database."""
    MBSDF = "mbsdf"
    """Linear colours of reflection and transmission over both polar angles, as MDL has them."""
    MUELLER = "mueller"
    """Mueller matrices at five wavelengths over half and difference angles, as Mitsuba reads them."""
