"""The film solver against programs and numbers that share nothing with it.

Stacks computed with 60 digits; S. J. Byrnes's tmm (arXiv 1603.02720), transfer matrices; PyMoosh, scattering
matrices (D. Langevin et al., J. Opt. Soc. Am. B 41 (2024)); and two laws: nothing is lost in a clear stack,
and a stack transmits as much backwards.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kernel_film import kernel_film
from nacreous.opencl.device import open_device
from nacreous.opencl.precision import Precision
from nacreous.tables.self_test import golden_errors, goldens
from validation.comparison import Comparison
from validation.drawing import GRID, INK, dress, figure
from validation.page import rounded, table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

STACKS = 250
WAVELENGTH_NM = 550.0
LEAST_SHOWN = 1e-17
"""Differences below it are drawn there: two doubles about 1 that differ by less are equal."""


@dataclass(frozen=True)
class RandomStack:
    """Air, one to eight layers and glass; or with clear layers alone."""

    index: list[complex]
    thickness_nm: list[float]
    cos_theta: float

    @property
    def reversed(self) -> "RandomStack":
        """Return the same stack lit from its other side, at the refracted angle."""
        sine = np.sqrt(1 - self.cos_theta**2) * self.index[0].real / self.index[-1].real
        return RandomStack(self.index[::-1], self.thickness_nm[::-1], float(np.sqrt(1 - sine**2)))


@dataclass(frozen=True, eq=False)
class Witness:
    """Whom the solver is compared with, on what, and all absolute differences of R and T by precision."""

    name: str
    work: str
    differences: Mapping[Precision, FloatArray]


def random_stacks(most_k: float) -> list[RandomStack]:
    """Make stacks whose layers absorb, two in five, with k up to `most_k`."""
    rng = np.random.default_rng(2015)
    stacks = []
    for layers in rng.integers(1, 9, STACKS):
        k = np.where(rng.random(layers) < 0.4, rng.uniform(0, most_k, layers), 0)
        index = [1.0 + 0j, *(rng.uniform(0.2, 3, layers) + 1j * k), 1.5 + 0j]
        stacks.append(RandomStack(index, rng.uniform(5, 400, layers).tolist(), float(rng.uniform(0.05, 1))))
    return stacks


def ours(stack: RandomStack, precision: Precision) -> FloatArray:
    """R_s, R_p, T_s and T_p by the kernels, (4,)."""
    given = (stack.index, stack.thickness_nm, WAVELENGTH_NM, stack.cos_theta)
    return np.ravel(kernel_film(*given, precision=precision))


def of_tmm(stack: RandomStack) -> FloatArray:
    """Return the same by tmm."""
    import tmm

    given = (stack.index, [np.inf, *stack.thickness_nm, np.inf], np.arccos(stack.cos_theta), WAVELENGTH_NM)
    s, p = (tmm.coh_tmm(polarisation, *given) for polarisation in "sp")
    return np.array([s["R"], p["R"], s["T"], p["T"]])


def of_pymoosh(stack: RandomStack) -> FloatArray:
    """Return the same by PyMoosh, whose polarisations are numbers and whose media are permittivities."""
    from PyMoosh import Structure, coefficient_S

    media = list(range(len(stack.index)))
    structure = Structure([n**2 for n in stack.index], media, [0.0, *stack.thickness_nm, 0.0], verbose=False)
    s, p = (
        coefficient_S(structure, WAVELENGTH_NM, np.arccos(stack.cos_theta), number)[2:] for number in (0, 1)
    )
    return np.array([s[0], p[0], s[1], p[1]], float)


def measure() -> list[Witness]:
    """Compare with every witness."""
    absorbing, tinted, clear = (random_stacks(most_k) for most_k in (4.0, 0.1, 0.0))
    programs = f"{STACKS} random stacks of 1 to 8 layers"
    return [
        _of_60_digits(),
        _witness("tmm", programs, lambda precision: _apart(absorbing, of_tmm, precision)),
        _witness("PyMoosh", programs, lambda precision: _apart(absorbing, of_pymoosh, precision)),
        _witness("R + T = 1", f"{STACKS} clear stacks", lambda precision: _lost(clear, precision)),
        _witness("T backwards", f"{STACKS} tinted stacks", lambda precision: _one_way(tinted, precision)),
    ]


def _witness(name: str, work: str, differences: Callable[[Precision], FloatArray]) -> Witness:
    return Witness(name, work, {precision: differences(precision) for precision in Precision})


def _of_60_digits() -> Witness:
    device, cases = open_device(), list(goldens())
    kinds = len({case.kind for case in cases})
    most = max(case.problem.thickness_nm.size for case in cases)
    work = f"{len(cases)} stacks of {kinds} kinds, up to {most} layers"
    return _witness("60 digits", work, lambda precision: golden_errors(device, cases, precision).ravel())


def _apart(
    stacks: list[RandomStack], witness: Callable[[RandomStack], FloatArray], precision: Precision
) -> FloatArray:
    return np.concatenate([np.abs(ours(stack, precision) - witness(stack)) for stack in stacks])


def _lost(stacks: list[RandomStack], precision: Precision) -> FloatArray:
    sums = [ours(stack, precision).reshape(2, 2).sum(axis=0) for stack in stacks]
    return np.abs(np.concatenate(sums) - 1)


def _one_way(stacks: list[RandomStack], precision: Precision) -> FloatArray:
    both = [(ours(stack, precision), ours(stack.reversed, precision)) for stack in stacks]
    return np.concatenate([np.abs(there - back)[2:] for there, back in both])


def headline(witnesses: list[Witness]) -> str:
    """Say the largest difference from anybody in both precisions."""
    double, single = (
        max(witness.differences[precision].max() for witness in witnesses)
        for precision in (Precision.DOUBLE, Precision.SINGLE)
    )
    return f"R and T within {rounded(double)} in double precision, {rounded(single)} in single"


def numbers(witnesses: list[Witness]) -> str:
    """Say the largest difference from each."""
    header = "witness | of what | double precision, largest: | single precision, largest: | single, median:"
    return table(header, [_row(witness) for witness in witnesses])


def _row(witness: Witness) -> str:
    double, single = (witness.differences[precision] for precision in (Precision.DOUBLE, Precision.SINGLE))
    cells = map(rounded, (double.max(), single.max(), np.median(single)))
    return " | ".join([witness.name, witness.work, *cells])


COLOURS = ("#22262b", "#2f6fb4", "#c2571a", "#3a8f4d", "#8a4fa3")


def draw(witnesses: list[Witness]) -> "Figure":
    """Draw which share of all differences is larger than which."""
    drawn = figure(3.5)
    axes = drawn.add_axes((0.08, 0.15, 0.73, 0.76))
    for witness, colour in zip(witnesses, COLOURS, strict=True):
        for precision, style in ((Precision.DOUBLE, "-"), (Precision.SINGLE, (0, (3, 1.5)))):
            ordered = np.sort(np.maximum(witness.differences[precision], LEAST_SHOWN))
            larger = 1 - np.arange(ordered.size) / ordered.size
            label = witness.name if precision is Precision.DOUBLE else None
            axes.plot(ordered, larger, color=colour, ls=style, lw=1.6, label=label)
    _dress(axes)
    return drawn


def _dress(axes: "Axes") -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(LEAST_SHOWN, 1e-4)
    axes.set_ylim(7e-4, 1.25)
    axes.grid(color=GRID, lw=0.7)
    axes.text(3e-15, 1.3, "double precision", size=9, color=INK, ha="center")
    axes.text(2e-6, 1.3, "single precision, dashed", size=9, color=INK, ha="center")
    axes.legend(frameon=False, fontsize=9, loc="center left", bbox_to_anchor=(1.01, 0.5), labelcolor=INK)
    dress(axes, "", "absolute difference of R or T", "share of differences at least as large")


COMPARISON = Comparison(
    name="film-solver",
    title="The film solver",
    against="60-digit results, tmm, PyMoosh",
    measure=measure,
    headline=headline,
    numbers=numbers,
    draw=draw,
    palette=128,
)
