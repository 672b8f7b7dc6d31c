"""What a table costs beyond one film: periods, lookup textures, whole processes."""

import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np

from bench.ours import film_problem
from bench.stack import BenchStack, bench_stack
from nacreous.opencl.device import Device, open_device
from nacreous.opencl.film import film_intensities
from nacreous.opencl.film_colour import Side, film_colours
from nacreous.opencl.film_problem import FilmProblem, Segment
from nacreous.opencl.precision import Precision

RUNS = 9

PROGRAM = str(Path(sys.executable).with_name("nacreous"))
TABULATE = (PROGRAM, "tabulate", "paper/figure-3", "--format", "exr", "-o")


LAUNCHER = """
import resource, subprocess, sys
subprocess.run(sys.argv[1:], check=True)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
"""


@dataclass(frozen=True)
class Figure:
    """One measured number and what it is aimed at, both ready to read."""

    what: str
    measured: str
    target: str


def scaling_figures() -> list[Figure]:
    """Measure everything, the whole processes last."""
    device = open_device()
    return [*_period_figures(device), _colour_figure(device), *_process_figures()]


def _period_figures(device: Device) -> list[Figure]:
    """Compare 1,000 periods of two layers with one, in either precision, without and with absorption."""
    pairs = {"lossless": _layers_of(bench_stack(), [2, 4]), "absorbing": _layers_of(bench_stack(), [3, 5])}
    return [
        _period_figure(device, kind, pair, precision)
        for kind, pair in pairs.items()
        for precision in Precision
    ]


def _period_figure(device: Device, kind: str, pair: BenchStack, precision: Precision) -> Figure:
    one, many = (film_problem(pair, repeat) for repeat in (1, 1000))
    ratio = _median_seconds(partial(film_intensities, device, many, precision)) / _median_seconds(
        partial(film_intensities, device, one, precision)
    )
    name = f"1,000 {kind} periods of two layers against one, {precision.name.lower()} precision"
    return Figure(name, f"{ratio:.1f} x the time", "3 x")


def _layers_of(stack: BenchStack, layers: list[int]) -> BenchStack:
    kept = [0, *layers, -1]
    return replace(stack, index=stack.index[kept], thickness_nm=stack.thickness_nm[np.array(layers) - 1])


def _colour_figure(device: Device) -> Figure:
    """Compute a lookup texture of one film, 512 x 512 texels from 401 wavelengths."""
    wavelength_nm = np.linspace(350, 750, 401)
    index = np.array([1.0, 2.0, 1.5])[:, None] * np.ones(401, complex)
    problem = FilmProblem(
        wavelength_nm=wavelength_nm,
        index=index,
        segments=(Segment(0, 1, 1),),
        thickness_nm=420 * np.linspace(0.5, 1.5, 512).reshape(512, 1, 1),
        weights=np.ones(1),
        cos_theta=np.linspace(0, 1, 512),
    )
    weights = np.ones((3, 401)) / 401
    seconds = _median_seconds(
        lambda: film_colours(device, problem, weights, (Side.REFLECTION,), Precision.SINGLE)
    )
    return Figure("colour texture, 512 x 512 from 401 wavelengths", f"{seconds:.3f} s", "0.25 s")


def _process_figures() -> list[Figure]:
    """Whole processes: wall time of a small texture and of --help, peak memory of a large texture."""
    with tempfile.TemporaryDirectory() as folder:
        small = _median_seconds(lambda: _run(*TABULATE, folder))
        large = _peak_bytes(
            *TABULATE,
            folder,
            *("--set", "table.cos_theta=512"),
            *("--set", "table.thickness_scale={start=0.5, stop=1.5, count=512}"),
        )
    usage = _median_seconds(lambda: _run(PROGRAM, "--help"))
    return [
        Figure(
            "`nacreous tabulate paper/figure-3 --format exr`, kernels compiled", f"{small:.2f} s", "1.0 s"
        ),
        Figure("`nacreous --help`", f"{usage:.2f} s", "0.3 s"),
        Figure("peak memory of the process, 512 x 512 texels", f"{large / 1e6:.0f} MB", "500 MB"),
    ]


def _median_seconds(run: Callable[[], object]) -> float:
    run()  # compiles, and fills caches
    seconds = []
    for _ in range(RUNS):
        start = time.perf_counter()
        run()
        seconds.append(time.perf_counter() - start)
    return statistics.median(seconds)


def _run(*arguments: str) -> None:
    subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL)


def _peak_bytes(*arguments: str) -> int:
    """Run a process under a small one, for a child begins with its parent's memory; its largest set."""
    done = subprocess.run(
        [sys.executable, "-c", LAUNCHER, *arguments], check=True, capture_output=True, text=True
    )
    return int(done.stdout.split()[-1]) * 1024
