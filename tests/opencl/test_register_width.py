"""Lanes are as wide as the registers of both the processor and the compiler."""

from pathlib import Path

import pytest

from nacreous.opencl.device import Device
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.opencl.register_width import lane_width

FILM = (("INCOHERENT", 0), ("PERIODIC", 0), ("MEDIA", 4), ("POLYNOMIALS", 0), ("DEGREE", 0))


@pytest.mark.parametrize("precision", Precision)
def test_the_chosen_width_builds(precision: Precision, device: Device) -> None:
    """A lane that needs registers unknown to the compiler is a warning there, and warnings are errors."""
    build = Build("film", precision, lane_width(device.queue.device, precision), FILM)
    assert kernel_of(device, build).function_name == "film"


@pytest.mark.parametrize("precision", Precision)
def test_a_lane_fits_the_registers_of_this_processor(precision: Precision, device: Device) -> None:
    """x86-64 has at least 128 bits; AVX has 256, AVX-512 512 (Intel 64 manual, volume 1, sections 14, 15)."""
    processor = Path("/proc/cpuinfo").read_text()
    bits = 512 if "avx512f" in processor else 256 if "avx" in processor else 128
    assert 128 <= lane_width(device.queue.device, precision) * precision.value <= bits
