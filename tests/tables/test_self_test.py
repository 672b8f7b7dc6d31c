"""The self-test finds a device that computes wrongly."""

import numpy as np
import pytest

from nacreous.opencl.precision import Precision
from nacreous.tables import self_test
from nacreous.tables.self_test import SelfTest, goldens, run_self_test


def test_this_device_passes() -> None:
    """All 400 stacks in both precisions."""
    result = run_self_test()
    assert result.passed
    assert (result.cases, result.nonfinite) == (400, 0)


@pytest.mark.parametrize(
    "faulty",
    [
        SelfTest(400, 4e-5, 1e-14, 0),
        SelfTest(400, 1e-6, 2e-12, 0),
        SelfTest(400, 1e-6, 1e-14, 1),
    ],
)
def test_one_fault_is_enough(faulty: SelfTest) -> None:
    """Too large an error in either precision, or one result that is not finite."""
    assert not faulty.passed


@pytest.mark.parametrize("poison", [np.nan, 1e-3])
def test_a_wrong_device_fails(poison: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """A device that is wrong in single precision alone, for one kind of stack in nine."""
    honest = self_test.film_intensities

    def wrong(device: object, problem: object, precision: Precision) -> dict[str, np.ndarray]:
        computed = honest(device, problem, precision)  # type: ignore[arg-type]
        broken = precision is Precision.SINGLE and problem.index[0, 0] == 1.0  # type: ignore[attr-defined]
        return {n: v + poison if broken else v for n, v in computed.items()}

    monkeypatch.setattr(self_test, "film_intensities", wrong)
    assert not run_self_test().passed


def test_goldens_are_stacks() -> None:
    """Media 0 ... M + 1, k >= 0, a clear incident medium (kernels/README.md), and results that are ratios."""
    for golden in goldens():
        problem = golden.problem
        assert problem.index.shape == (problem.thickness_nm.size + 2, 1)
        assert problem.index.imag.min() >= 0
        assert problem.index[0].imag.item() == 0
        assert 0 <= golden.exact.min() <= golden.exact.max() <= 1
