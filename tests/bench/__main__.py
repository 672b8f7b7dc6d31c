"""Run every program on the same film and write docs/benchmarks.md: `python -m bench`, tests on the path."""

import sys
from pathlib import Path

from bench.albedo import albedo_measurements, albedo_work
from bench.ours import FLOP_PER_LAYER_EVALUATION, ours
from bench.page import Pair, render
from bench.roofline import measure_roofline
from bench.scaling import scaling_figures
from bench.stack import BenchStack, bench_stack
from bench.timing import Measurement, Missing, measure
from bench.witnesses import Witness, witnesses

PAGE = Path(__file__).parents[2] / "docs/benchmarks.md"


def main() -> None:
    """Measure, print as it goes, write the page."""
    stack = bench_stack()
    own = ours()
    pairs = [Pair(_measured_if_installed(witness, stack), _measured(own, stack)) for witness in witnesses()]
    page = render(
        _measured(own, stack),
        pairs,
        measure_roofline(),
        scaling_figures(),
        stack=stack,
        albedo_work=albedo_work(),
        albedos=albedo_measurements(),
        flop_per_layer_evaluation=FLOP_PER_LAYER_EVALUATION,
    )
    PAGE.parent.mkdir(exist_ok=True)
    PAGE.write_text(page)
    sys.stdout.write(page)


def _measured(witness: Witness, stack: BenchStack) -> Measurement:
    sys.stderr.write(f"{witness.name} ...\n")
    part = stack.thinned(witness.angle_step, witness.wavelength_step)
    return measure(witness.name, witness.make(), part, witness.runs)


def _measured_if_installed(witness: Witness, stack: BenchStack) -> Measurement | Missing:
    try:
        return _measured(witness, stack)
    except ModuleNotFoundError as missing:
        return Missing(witness.name, f"{missing.name} is not installed")


if __name__ == "__main__":
    main()
