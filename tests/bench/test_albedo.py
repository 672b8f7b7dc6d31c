"""The programs of the albedo benchmark compute the same table."""

import numpy as np
import pytest

from bench import albedo
from mitsuba_surface import variant_fault

WORK = albedo.AlbedoWork(np.array([0.2, 0.5]), np.array([0.3, 0.9]), np.array([420.0, 500.0, 580.0, 660.0]))


@pytest.mark.parametrize("program", [albedo.by_numpy, albedo.by_mitsuba, albedo.ours])
def test_programs_agree_with_brute_force(program: albedo.AlbedoProgram) -> None:
    """Three integrals of equation 12, each against its Monte Carlo in double precision."""
    if program is albedo.by_mitsuba and (fault := variant_fault(albedo.VARIANT)):
        pytest.skip(fault)
    places, expected = albedo.reference_samples(WORK)
    assert albedo.measure_albedo("program", program, WORK, places, expected).largest_error <= 5e-3


def test_a_program_that_computes_something_else_is_not_timed() -> None:
    """Its albedo is half of what is right."""
    places, expected = albedo.reference_samples(WORK)
    with pytest.raises(AssertionError, match=r"half is .* off the reference"):
        albedo.measure_albedo("half", lambda work: albedo.by_numpy(work) / 2, WORK, places, expected)
