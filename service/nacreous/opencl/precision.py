"""Precision of the kernels' arithmetic."""

from enum import Enum

import numpy as np
from numpy.typing import DTypeLike

__all__ = ["Precision"]


class Precision(Enum):
    """Bits of a real number on the device; the value is what the kernels' build option REAL takes."""

    SINGLE = 32
    DOUBLE = 64

    @property
    def dtype(self) -> DTypeLike:
        """The NumPy type of the same bits."""
        return np.float32 if self is Precision.SINGLE else np.float64
