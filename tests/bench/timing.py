"""One way to check and to time every program of the benchmark."""

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from bench.stack import BenchStack
from reference import Intensities, film

Solver = Callable[[BenchStack], Intensities]
"""From a stack in host memory to R_s, R_p, T_s, T_p in host memory, each (A, L)."""

LARGEST_ERROR = 1e-4
"""A program that is further from the reference than this computes something else and is not timed."""


@dataclass(frozen=True)
class Measurement:
    """What one program did."""

    name: str
    layer_evaluations_per_second: float
    largest_error: float


@dataclass(frozen=True)
class Missing:
    """A program that is not on this machine."""

    name: str
    reason: str


def measure(name: str, solve: Solver, stack: BenchStack, runs: int) -> Measurement:
    """Check `solve` against the double-precision reference, then time it: the median of several runs.

    The check is the warm-up: compilers have compiled and caches are filled when the clock starts.

    Raises
    ------
    AssertionError
        Where the results disagree with the reference.
    """
    error = largest_error(solve(stack), stack)
    if not error <= LARGEST_ERROR:
        raise AssertionError(f"{name} is {error:.1e} off the reference, more than {LARGEST_ERROR:.0e}")
    seconds = statistics.median(_seconds(solve, stack) for _ in range(runs))
    return Measurement(name, stack.layer_evaluations / seconds, error)


def largest_error(table: Intensities, stack: BenchStack) -> float:
    """Largest difference from the reference over up to 16 x 50 samples of all four tables."""
    angle_step, wavelength_step = -(-len(stack.cos_theta) // 16), -(-len(stack.wavelength_nm) // 50)
    part = stack.thinned(angle_step, wavelength_step)
    expected = film(part.index, part.thickness_nm, part.wavelength_nm, part.cos_theta)
    samples = np.s_[angle_step // 2 :: angle_step, wavelength_step // 2 :: wavelength_step]
    return max(
        float(np.abs(np.asarray(getattr(table, name))[samples] - getattr(expected, name)).max())
        for name in Intensities._fields
    )


def _seconds(solve: Solver, stack: BenchStack) -> float:
    start = time.perf_counter()
    solve(stack)
    return time.perf_counter() - start
