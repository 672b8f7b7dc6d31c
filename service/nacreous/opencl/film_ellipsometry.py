"""psi and Delta of a coherent film: the host of kernels/film_ellipsometry.cl."""

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.device import Device
from nacreous.opencl.film import spectral_rows
from nacreous.opencl.film_problem import FilmProblem
from nacreous.opencl.precision import Precision
from nacreous.opencl.tiles import Observer

__all__ = ["NAMES", "film_ellipsometry"]

NAMES = ("psi", "Delta")


def film_ellipsometry(
    device: Device,
    problem: FilmProblem,
    precision: Precision,
    *,
    observer: Observer | None = None,
    lanes: int | None = None,
) -> dict[str, NDArray[np.floating]]:
    """Ellipsometric psi and Delta in radians, each of shape (S, A, L), of a coherent film of one variant."""
    return spectral_rows(device, "film_ellipsometry", NAMES, problem, precision, observer, lanes)
