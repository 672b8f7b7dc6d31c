"""What the page says of the film solver, and that its witnesses are witnesses."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from kernel_film import DOUBLE_TOLERANCE, SINGLE_TOLERANCE
from nacreous.opencl.precision import Precision
from validation.film_solver import Witness, of_pymoosh, of_tmm, random_stacks


@pytest.fixture(scope="module")
def witnesses(measured: Callable[[str], Any]) -> dict[str, Witness]:
    """Compare with all of them."""
    return {witness.name: witness for witness in measured("film-solver")}


@pytest.mark.parametrize("name", ["60 digits", "tmm", "PyMoosh", "R + T = 1", "T backwards"])
def test_every_witness_agrees(witnesses: dict[str, Witness], name: str) -> None:
    """R and T within 1e-12 in double precision and within 2e-5 in single, on every stack."""
    differences = witnesses[name].differences
    assert np.nanmax(differences[Precision.DOUBLE]) <= DOUBLE_TOLERANCE
    assert np.nanmax(differences[Precision.SINGLE]) <= SINGLE_TOLERANCE
    assert all(np.isfinite(values).all() for values in differences.values())


def test_the_witnesses_agree_with_each_other() -> None:
    """Transfer and scattering matrices, by two authors: the same R and T, s before p, R before T."""
    for stack in random_stacks(most_k=4.0)[:20]:
        np.testing.assert_allclose(of_tmm(stack), of_pymoosh(stack), rtol=0, atol=1e-11)


def test_the_stacks_are_of_the_stated_kind() -> None:
    """One to eight layers, two in five absorbing; k = 0 makes all of them clear."""
    stacks = random_stacks(most_k=4.0)
    layers = [stack.index[1:-1] for stack in stacks]
    assert {len(each) for each in layers} == set(range(1, 9))
    assert np.mean([n.imag > 0 for each in layers for n in each]) == pytest.approx(0.4, abs=0.05)
    assert all(n.imag == 0 for stack in random_stacks(most_k=0.0) for n in stack.index)
    assert stacks[0].reversed.index == stacks[0].index[::-1]
