"""Does this device compute films rightly? Stacks with known results, computed on this machine.

The goldens were computed with 60 digits: absorbing, opaque, thick, grazing and totally reflecting stacks of
up to 60 layers.
"""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.opencl.device import Device, open_device
from nacreous.opencl.film import NAMES, film_intensities
from nacreous.opencl.film_problem import FilmProblem, Segment
from nacreous.opencl.precision import Precision
from nacreous.tables.film import phase_precision

__all__ = ["Golden", "SelfTest", "golden_errors", "goldens", "run_self_test"]

DOUBLE_TOLERANCE = 1e-12
SINGLE_TOLERANCE = 3e-5


@dataclass(frozen=True, eq=False)
class Golden:
    """A stack at one wavelength and angle, and its exact R_s, R_p, T_s and T_p, shape (4,)."""

    kind: str
    problem: FilmProblem
    exact: NDArray[np.float64]


@dataclass(frozen=True)
class SelfTest:
    """What a device made of the goldens.

    Parameters
    ----------
    cases : int
        Stacks computed.
    worst_single, worst_double : float
        Largest error of R and T in either precision.
    nonfinite : int
        Results that are not finite.
    """

    cases: int
    worst_single: float
    worst_double: float
    nonfinite: int

    @property
    def passed(self) -> bool:
        """Whether every error is within what Nacreous promises."""
        exact = self.worst_double <= DOUBLE_TOLERANCE and self.worst_single <= SINGLE_TOLERANCE
        return exact and self.nonfinite == 0


def goldens() -> Iterator[Golden]:
    """Yield every stack with a known result."""
    text = files("nacreous.opencl").joinpath("film_goldens.json").read_text(encoding="utf-8")
    for case in json.loads(text)["cases"]:
        yield _golden(case)


def golden_errors(device: Device, cases: list[Golden], asked: Precision) -> NDArray[np.float64]:
    """Errors of R_s, R_p, T_s and T_p, shape (cases, 4), each in the precision that a table would have."""
    return np.array([_error(device, case, phase_precision(case.problem, asked)) for case in cases])


def run_self_test(selector: str | None = None) -> SelfTest:
    """Compute every golden in single and in double precision; raises `DeviceError` without a device."""
    device, cases = open_device(selector), list(goldens())
    single, double = (golden_errors(device, cases, precision) for precision in Precision)
    nonfinite = int(np.count_nonzero(~np.isfinite([single, double])))
    return SelfTest(len(cases), float(np.nanmax(single)), float(np.nanmax(double)), nonfinite)


def _error(device: Device, case: Golden, precision: Precision) -> NDArray[np.float64]:
    computed = film_intensities(device, case.problem, precision)
    return np.abs([float(computed[name].item()) for name in NAMES] - case.exact)


def _golden(case: dict[str, Any]) -> Golden:
    layers = len(case["d_nm"])
    problem = FilmProblem(
        wavelength_nm=np.array([case["wavelength_nm"]]),
        index=np.array([complex(n, k) for n, k in case["n"]])[:, None],
        segments=(Segment(0, layers, 1),),
        thickness_nm=np.array(case["d_nm"]).reshape(1, 1, layers),
        weights=np.ones(1),
        cos_theta=np.array([case["cos_theta"]]),
    )
    return Golden(case["kind"], problem, np.array([case[name] for name in NAMES]))
