"""What the benchmark compares computes the same film; what it writes is what it measured."""

from types import ModuleType

import numpy as np
import pytest

from bench import complex_recursion, real_recursion
from bench.albedo import AlbedoMeasurement, albedo_work
from bench.page import Pair, render
from bench.roofline import Roofline
from bench.scaling import Figure
from bench.stack import BenchStack, bench_stack
from bench.timing import Measurement, Missing, largest_error, measure
from bench.witnesses import Witness, witnesses
from reference import Intensities

SINGLE_PRECISION = 5e-6
"""Error of the recursion on the benchmark's film in single precision."""


@pytest.fixture(scope="module")
def small_stack() -> BenchStack:
    """Make a film of the benchmark's kind with few samples."""
    return bench_stack().thinned(angle_step=128, wavelength_step=50)


@pytest.mark.parametrize("witness", witnesses(), ids=lambda witness: witness.name)
def test_every_witness_agrees_with_the_reference(witness: Witness, small_stack: BenchStack) -> None:
    """A benchmark compares programs that compute the same: R and T, s and p, in the same order."""
    try:
        solve = witness.make()
    except ModuleNotFoundError as missing:
        pytest.skip(f"{missing.name} is not installed")
    assert largest_error(solve(small_stack), small_stack) < SINGLE_PRECISION


@pytest.mark.parametrize("recursion", [complex_recursion, real_recursion], ids=lambda m: m.__name__)
def test_the_recursions_are_right_before_they_are_compiled(
    recursion: ModuleType, small_stack: BenchStack
) -> None:
    """Both forms of the field recursion agree with the reference in NumPy."""
    n, mu = small_stack.index, small_stack.cos_theta[:, None]
    clear = (n[1:-1].imag == 0).all(axis=1)
    index = (n,) if recursion is complex_recursion else ((n.real, n.imag), clear)
    got = recursion.film(np, *index, small_stack.thickness_nm, small_stack.wavelength_nm, mu)
    assert largest_error(Intensities(*got), small_stack) < SINGLE_PRECISION


def test_a_wrong_program_is_not_timed(small_stack: BenchStack) -> None:
    """Speed without the result is no result."""
    shape = (len(small_stack.cos_theta), len(small_stack.wavelength_nm))
    with pytest.raises(AssertionError, match="off the reference"):
        measure("guess", lambda _: Intensities(*np.full((4, *shape), 0.5)), small_stack, runs=1)


def test_the_bench_stack_is_the_stated_work() -> None:
    """Ten layers, two in five absorbing, 400 wavelengths, 1024 angles, exact in single precision."""
    stack = bench_stack()
    assert stack.layer_evaluations == 10 * 400 * 1024
    assert (stack.index[1:-1].imag > 0).any(axis=1).sum() == 4
    assert all(np.all(a == a.astype(np.float32)) for a in (stack.wavelength_nm, stack.cos_theta))


def test_the_page_states_rates_ratios_and_shares() -> None:
    """300 M/s is 15 times 20 M/s; at 100 flop each it is 30 GFLOP/s, a tenth of 300."""
    page = render(
        Measurement("ours", 300e6, 2e-6),
        [
            Pair(Measurement("theirs", 20e6, 1e-6), Measurement("ours", 300e6, 2e-6)),
            Pair(Missing("absent", "jax is not installed"), Measurement("ours", 310e6, 2e-6)),
        ],
        Roofline("a device", 300e9, 16e9),
        [Figure("a texture", "0.2 s", "0.25 s")],
        stack=bench_stack(),
        albedo_work=albedo_work(),
        albedos=[AlbedoMeasurement("renderer", 3.0, 2e-3), AlbedoMeasurement("own", 0.1, 1e-4)],
        flop_per_layer_evaluation=100,
    )
    assert "| theirs | 20 | 15 x | 1.0e-06 |" in page
    assert "| absent | jax is not installed | | |" in page
    assert "| **ours** | **300** | | **2.0e-06** |" in page
    assert "| a texture | 0.2 s | 0.25 s |" in page
    assert "| multiply-adds | 300 GFLOP/s | 30.0 GFLOP/s | 10% |" in page
    assert "| renderer | 3 | 30 x | 2.0e-03 |" in page
    assert "| own | 0.1 |  | 1.0e-04 |" in page
