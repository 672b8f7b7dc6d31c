"""The roughness strip of a preview: the colour of a surface's albedo from smooth to rough."""

from typing import TYPE_CHECKING

import numpy as np

from nacreous.cli.preview_style import INK, dress, note
from nacreous.cli.preview_surface import STRIP_ANGLES, RoughTables
from nacreous.formats.srgb import encoded

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    Exposed = NDArray[np.float64]

__all__ = ["draw_roughness"]
