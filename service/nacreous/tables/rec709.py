"""The colours of a table as those of a screen: linear Rec.709."""

import numpy as np
from numpy.typing import NDArray

from nacreous.optics.colour import colour_system
from nacreous.tables.spec import ColourSpec

__all__ = ["rec709"]


def rec709(colours: NDArray[np.floating], colour: ColourSpec) -> NDArray[np.floating]:
    """Return table colours, shape (…, 3), in linear Rec.709; those of a table in Rec.709 are as they were."""
    if colour.space == "Rec.709":
        return colours
    table, screen = (
        colour_system(colour.illuminant, colour.observer, space) for space in (colour.space, "Rec.709")
    )
    to_screen = screen.from_xyz @ np.linalg.inv(table.from_xyz)  # both start at the illuminant's XYZ
    return np.asarray(colours @ to_screen.T)
