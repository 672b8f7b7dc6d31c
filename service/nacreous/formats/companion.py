"""Companions: a picture of a film is two files, of what it reflects and of what it transmits."""

from nacreous.formats.names import FormatName

__all__ = ["ACCOMPANIED", "TRANSMISSION"]

TRANSMISSION = ".transmission"
"""What the name of a companion has before its suffix, as in ``film.transmission.exr``."""

ACCOMPANIED = frozenset({FormatName.EXR, FormatName.SPECTRAL_EXR, FormatName.PNG})
"""Formats that have the transmitted part in a file of its own."""
