"""Programs: built once, with warnings as errors, and a fault is found by file and line."""

import shutil
from dataclasses import replace
from itertools import product
from pathlib import Path

import pytest

from lane_widths import lane_widths
from nacreous.errors import DeviceError
from nacreous.opencl import sources
from nacreous.opencl.device import Device
from nacreous.opencl.layer_polynomials import DEGREES as LAYER_DEGREES
from nacreous.opencl.polynomials import Form
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.opencl.stack_polynomials import DEGREES as STACK_DEGREES


def test_a_kernel_is_built_once(device: Device) -> None:
    """The same build is the same kernel; in another lane width it is another."""
    build = Build(
        "film",
        Precision.SINGLE,
        4,
        (("INCOHERENT", 0), ("PERIODIC", 0), ("MEDIA", 4), ("POLYNOMIALS", 0), ("DEGREE", 0)),
    )
    assert kernel_of(device, build) is kernel_of(device, build)
    assert kernel_of(device, replace(build, lanes=1)) is not kernel_of(device, build)


@pytest.mark.parametrize(
    ("fault", "told"),
    [
        pytest.param("lane fault = no_such_name;", "no_such_name", id="error"),
        pytest.param("static inline int fault(void) {}", "does not return a value", id="warning"),
    ],
)
def test_a_fault_is_found_by_file_and_line(
    fault: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, device: Device
) -> None:
    """A fault planted in a header that is included three deep is reported there, not in the expanded text."""
    folder = tmp_path / "my kernels"
    shutil.copytree(sources.KERNELS, folder)
    header = folder / "complex.clh"
    lines = header.read_text().splitlines()
    lines.insert(-1, fault)
    header.write_text("\n".join(lines))
    monkeypatch.setattr(sources, "KERNELS", folder)
    build = Build(
        "film",
        Precision.SINGLE,
        4,
        (
            ("INCOHERENT", 0),
            ("PERIODIC", 0),
            ("MEDIA", 4),
            ("POLYNOMIALS", 0),
            ("DEGREE", 0),
            ("FAULT", len(fault)),
        ),
    )
    with pytest.raises(DeviceError, match="kernel film does not build") as refused:
        kernel_of(device, build)
    assert f"complex.clh:{len(lines) - 1}:" in str(refused.value)
    assert told in str(refused.value)


FACET_NUMBERS = [
    (("DISTRIBUTION", distribution), ("MASKING", masking), ("AREA_COSINES", 257), ("AREA_AZIMUTHS", 17))
    for distribution, masking in product(range(5), range(3))
]
"""Of kernels/microfacet.clh: five distributions, three maskings."""


FILM_NUMBERS = {
    "film": ("INCOHERENT", "PERIODIC"),
    "film_colour": ("INCOHERENT", "PERIODIC"),
    "film_ellipsometry": ("INCOHERENT", "PERIODIC"),
}
ROUGH_KERNELS = ("microfacet_area", "albedo_weights", "bsdf", "bsdf_colour")


@pytest.mark.parametrize("precision", Precision)
def test_a_kernel_without_lanes_builds(precision: Precision, device: Device) -> None:
    """The warp takes a point at a time."""
    assert kernel_of(device, Build("warp", precision, 1)).function_name == "warp"


def ways_to_build(device: Device) -> list[tuple[Precision, int]]:
    """Both precisions, each in every lane width."""
    return [(precision, lanes) for precision in Precision for lanes in lane_widths(device, precision)]


def test_every_kernel_is_built_here() -> None:
    """A new kernel must be added below."""
    assert (
        sorted(
            [
                *FILM_NUMBERS,
                *ROUGH_KERNELS,
                "layer_polynomials",
                "microfacets",
                "register_width",
                "stack_polynomials",
                "warp",
            ]
        )
        == sources.kernel_names()
    )


@pytest.mark.parametrize("kernel", FILM_NUMBERS)
@pytest.mark.parametrize("precision", Precision)
def test_film_kernels_build_without_a_warning(kernel: str, precision: Precision, device: Device) -> None:
    """With -Werror, for every precision and lane width; the options on and off."""
    for lanes, switch in product(lane_widths(device, precision), (0, 1)):
        switches = ((name, switch) for name in FILM_NUMBERS[kernel])
        numbers = (*switches, ("MEDIA", 4), ("SIDES", 1 + switch), ("POLYNOMIALS", 0), ("DEGREE", 0))
        assert kernel_of(device, Build(kernel, precision, lanes, numbers)).function_name == kernel


@pytest.mark.parametrize("degree", LAYER_DEGREES)
def test_films_of_polynomial_layers_build_without_a_warning(degree: int, device: Device) -> None:
    """Their coefficients and what reads them, in single precision and every lane width."""
    for lanes in lane_widths(device, Precision.SINGLE):
        coefficients = Build("layer_polynomials", Precision.SINGLE, lanes, (("DEGREE", degree),))
        assert kernel_of(device, coefficients).function_name == "layer_polynomials"
        for kernel, periodic in product(FILM_NUMBERS, (0, 1)):
            build = Build(
                kernel, Precision.SINGLE, lanes, polynomial_numbers(Form.OF_LAYERS, degree, periodic)
            )
            assert kernel_of(device, build).function_name == kernel


@pytest.mark.parametrize("degree", STACK_DEGREES)
def test_films_of_polynomial_stacks_build_without_a_warning(degree: int, device: Device) -> None:
    """Their coefficients, which waves cross the layers for, and what reads them."""
    for lanes in lane_widths(device, Precision.SINGLE):
        waves = polynomial_numbers(Form.WAVES, degree)
        coefficients = Build("stack_polynomials", Precision.SINGLE, lanes, waves)
        assert kernel_of(device, coefficients).function_name == "stack_polynomials"
        for kernel in FILM_NUMBERS:
            build = Build(kernel, Precision.SINGLE, lanes, polynomial_numbers(Form.OF_STACK, degree))
            assert kernel_of(device, build).function_name == kernel


def polynomial_numbers(form: Form, degree: int, periodic: int = 0) -> tuple[tuple[str, int], ...]:
    """Return what a film kernel is built with."""
    film = ("INCOHERENT", 0), ("PERIODIC", periodic), ("MEDIA", 4), ("SIDES", 2)
    return (*film, ("POLYNOMIALS", form), ("DEGREE", degree))


@pytest.mark.parametrize("numbers", FACET_NUMBERS)
def test_facets_build_in_every_way(numbers: tuple[tuple[str, int], ...], device: Device) -> None:
    """Every distribution and masking in both precisions and every lane width: no warning, 120 kernels."""
    for precision, lanes in ways_to_build(device):
        kernel = kernel_of(device, Build("microfacets", precision, lanes, numbers))
        assert kernel.function_name == "microfacets"


@pytest.mark.parametrize("kernel", ROUGH_KERNELS)
def test_rough_kernels_build_in_every_width(kernel: str, device: Device) -> None:
    """Both precisions, every lane width, both sides; of all that facets can be, a few."""
    ways = product(ways_to_build(device), (0, 1))
    for way, ((precision, lanes), transmission) in enumerate(ways):
        numbers = (*FACET_NUMBERS[7 * way % len(FACET_NUMBERS)], ("TRANSMISSION", transmission))
        assert kernel_of(device, Build(kernel, precision, lanes, numbers)).function_name == kernel
