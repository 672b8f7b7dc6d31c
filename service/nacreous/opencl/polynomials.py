"""What films do to an angle as polynomials of mu^2: forms, nodes, and which work is worth them.

C and S / kz of a layer are entire functions of kz^2, which is linear in mu^2, and so is every entry of a
matrix that is made of them. Interpolated at Chebyshev nodes they need few terms.
"""

from dataclasses import dataclass
from enum import IntEnum
from functools import cache
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from nacreous.opencl.film_problem import FilmProblem

__all__ = [
    "MOST_NUMBERS",
    "TOLERANCE",
    "Form",
    "Polynomials",
    "is_worth_a_program",
    "node_mu2",
    "to_chebyshev",
]

TOLERANCE = 2.5e-7
"""What a wave loses as its phase, half a turn in a quarter-wave layer and its like, is rounded to 24 bits."""

_FEWEST_EVALUATIONS = 4_000_000
"""Fewer layers times angles times wavelengths take a few milliseconds either way, and are what moves under a
slider: a program of their own, which may first have to be compiled, would be felt."""

MOST_NUMBERS = 2**24
"""Coefficients of a film: 64 MB, beyond which it takes as long to read as to compute."""


class Form(IntEnum):
    """What an angle is evaluated by. Kernels know them by these numbers, as POLYNOMIALS."""

    WAVES = 0
    OF_LAYERS = 1
    OF_STACK = 2


@dataclass(frozen=True, eq=False)
class Polynomials:
    """What kernels read instead of waves: buffers of the device, each None where it has no use."""

    form: Form
    degree: int
    coefficients: Any
    chebyshev: Any = None

    @property
    def build_numbers(self) -> tuple[tuple[str, int], ...]:
        """What the kernels are compiled for."""
        return ("POLYNOMIALS", self.form), ("DEGREE", self.degree)


def is_worth_a_program(problem: FilmProblem) -> bool:
    """Tell whether a film is more than what moves under a slider."""
    evaluations = problem.thickness_nm.size * problem.cos_theta.size * problem.wavelength_nm.size
    return evaluations > 0 and evaluations >= _FEWEST_EVALUATIONS


@cache
def node_mu2(degree: int) -> NDArray[np.float64]:
    """Chebyshev nodes of mu^2 on [0, 1], ascending, (D + 1,)."""
    nodes: NDArray[np.float64] = (1 + chebyshev.chebpts1(degree + 1)) / 2
    return nodes


@cache
def to_chebyshev(degree: int) -> NDArray[np.float64]:
    """Return what takes values at the nodes to coefficients of Chebyshev polynomials, (order, node)."""
    values = chebyshev.chebvander(chebyshev.chebpts1(degree + 1), degree)  # (node, order)
    return np.linalg.inv(values).astype(np.float64)
