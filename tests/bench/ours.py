"""Nacreous's own film kernel as a program of the benchmark."""

import numpy as np

from bench.stack import BenchStack
from bench.timing import Solver
from bench.witnesses import Witness
from nacreous.opencl.device import open_device
from nacreous.opencl.film import film_intensities
from nacreous.opencl.film_problem import FilmProblem, Segment
from nacreous.opencl.precision import Precision
from reference import Intensities

DEGREE, PARTS = 10, 16
"""Of the polynomials that this stack is, and the real functions of the angle that both polarisations need."""

FLOP_PER_LAYER_EVALUATION = (2 * PARTS * DEGREE + 32) / 10
"""Multiplications and additions of a sample (kernels/polynomial_stack.clh), the sums and the fields made of
them, shared by the ten layers; the root of the substrate and R and T are left out."""


def ours() -> Witness:
    """Nacreous in single precision."""
    return Witness("Nacreous, OpenCL on PoCL, float32", make_nacreous, runs=15)


def make_nacreous() -> Solver:
    """Return a solver that runs from host arrays to host arrays, as a table does."""
    device = open_device()

    def solve(stack: BenchStack) -> Intensities:
        problem = film_problem(stack)
        return Intensities(**film_intensities_of_one_scale(problem))

    def film_intensities_of_one_scale(problem: FilmProblem) -> dict[str, np.ndarray]:
        computed = film_intensities(device, problem, Precision.SINGLE)
        return {name: values[0] for name, values in computed.items()}

    return solve


def film_problem(stack: BenchStack, repeat: int = 1) -> FilmProblem:
    """Return the benchmark's stack, its layers `repeat` times, as the kernels take it."""
    layers = stack.thickness_nm.size
    return FilmProblem(
        wavelength_nm=stack.wavelength_nm,
        index=stack.index,
        segments=(Segment(0, layers, repeat),),
        thickness_nm=stack.thickness_nm.reshape(1, 1, layers),
        weights=np.ones(1),
        cos_theta=stack.cos_theta,
    )
