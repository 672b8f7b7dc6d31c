"""The page of results, in Markdown."""

import os
import platform
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from bench.albedo import AlbedoMeasurement, AlbedoWork
from bench.roofline import Roofline
from bench.scaling import Figure
from bench.stack import BenchStack
from bench.timing import Measurement, Missing

PACKAGES = (
    "numpy",
    "jax",
    "torch",
    "mitsuba",
    "tmm",
    "tmm-fast",
    "tmm-faster",
    "pocl-binary-distribution",
    "pyopencl",
)


TEMPLATE = """\
# Benchmarks

Written by `make bench`; every number comes from the same run on the same machine.

## A film table

{work}

| | million layer evaluations a second | Nacreous is faster by | largest error |
|---|--:|--:|--:|
{rows}

Medians of several runs, from arrays in host memory to arrays in host memory, both polarisations together. A
ratio is to Nacreous measured right after the program, because a machine is not equally busy all the time.
Every program is checked before it is timed; its error is the largest difference of R or T from the
double-precision reference of the tests. Scalar tmm does a part of the samples.

## An albedo table

{albedo_work}

| | seconds | Nacreous is faster by | largest error |
|---|--:|--:|--:|
{albedo_rows}

## Roofline

Measured on {device}:

| | limit | the film kernel | share |
|---|--:|--:|--:|
{shares}

The kernel's {flop:.0f} flop a layer evaluation are counted in its source: a root, a reciprocal or a
polynomial as the multiplications and additions it takes.

## Periods, textures, processes

| | measured | target |
|---|--:|--:|
{figures}

## Machine

{machine}.
"""


@dataclass(frozen=True)
class Pair:
    """Another program, and our own measured right after it: the machine is as busy for both."""

    other: Measurement | Missing
    ours: Measurement


def render(
    ours: Measurement,
    pairs: Sequence[Pair],
    roofline: Roofline,
    figures: Sequence[Figure],
    *,
    stack: BenchStack,
    albedo_work: AlbedoWork,
    albedos: Sequence[AlbedoMeasurement | Missing],
    flop_per_layer_evaluation: float,
) -> str:
    """Write the page: the table of programs, our share of the roofline, what scales how, the machine."""
    return TEMPLATE.format(
        work=_work(stack),
        rows="\n".join([*map(_row, pairs), _own_row(ours)]),
        albedo_work=_albedo_work(albedo_work),
        albedo_rows="\n".join(_albedo_rows(albedos)),
        device=roofline.device,
        shares=_shares(ours, roofline, stack, flop_per_layer_evaluation),
        flop=flop_per_layer_evaluation,
        figures="\n".join(f"| {f.what} | {f.measured} | {f.target} |" for f in figures),
        machine=f"{_processor()}, {os.cpu_count()} cores; Python {platform.python_version()}; {_versions()}",
    )


def _work(stack: BenchStack) -> str:
    absorbing = int((stack.index[1:-1].imag > 0).any(axis=1).sum())
    return (
        f"R and T for s and p of {len(stack.thickness_nm)} dispersive layers, {absorbing} of them absorbing, "
        f"at {len(stack.wavelength_nm)} wavelengths and {len(stack.cos_theta)} angles."
    )


def _row(pair: Pair) -> str:
    other = pair.other
    if isinstance(other, Missing):
        return f"| {other.name} | {other.reason} | | |"
    ratio = pair.ours.layer_evaluations_per_second / other.layer_evaluations_per_second
    return f"| {other.name} | {_millions(other)} | {_two_digits(ratio)} x | {other.largest_error:.1e} |"


def _own_row(ours: Measurement) -> str:
    return f"| **{ours.name}** | **{_millions(ours)}** | | **{ours.largest_error:.1e}** |"


def _albedo_work(work: AlbedoWork) -> str:
    return (
        "Albedo of bare rough silver, GGX with separable Smith masking, at "
        f"{work.roughness.size} roughnesses, {work.cos_theta.size} angles and {work.wavelength_nm.size} "
        "wavelengths. Each program takes 4096 facets; Nacreous integrates over them once for all wavelengths."
    )


def _albedo_rows(albedos: Sequence[AlbedoMeasurement | Missing]) -> Iterator[str]:
    """One row a program; the last measured one is ours."""
    own = [albedo for albedo in albedos if isinstance(albedo, AlbedoMeasurement)][-1]
    for albedo in albedos:
        if isinstance(albedo, Missing):
            yield f"| {albedo.name} | {albedo.reason} | | |"
            continue
        ratio = "" if albedo is own else f"{_two_digits(albedo.seconds / own.seconds)} x"
        yield f"| {albedo.name} | {albedo.seconds:.2g} | {ratio} | {albedo.largest_error:.1e} |"


def _shares(ours: Measurement, roofline: Roofline, stack: BenchStack, flop: float) -> str:
    rate = ours.layer_evaluations_per_second
    written = 4 * 4 * rate / len(stack.thickness_nm)  # four float32 tables, one value a sample
    return "\n".join(
        [
            _share("multiply-adds", "GFLOP/s", roofline.flop_per_second, flop * rate),
            _share("memory", "GB/s", roofline.copied_bytes_per_second, written),
        ]
    )


def _share(name: str, unit: str, limit: float, used: float) -> str:
    return f"| {name} | {limit / 1e9:.0f} {unit} | {used / 1e9:.1f} {unit} | {used / limit:.0%} |"


def _millions(measurement: Measurement) -> str:
    return _two_digits(measurement.layer_evaluations_per_second / 1e6)


def _two_digits(value: float) -> str:
    """Two significant digits below a hundred, whole numbers above: the noise of the machine is larger."""
    return f"{value:.0f}" if value >= 10 else f"{value:.2g}"


def _processor() -> str:
    """Name of the processor, from Linux where it says so."""
    cpuinfo = Path("/proc/cpuinfo")
    lines = cpuinfo.read_text().splitlines() if cpuinfo.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.machine()


def _versions() -> str:
    return ", ".join(f"{name} {found}" for name in PACKAGES if (found := _version(name)))


def _version(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None
