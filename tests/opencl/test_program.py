"""Programs: built once, with warnings as errors, and a fault is found by file and line."""

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from nacreous.errors import DeviceError
from nacreous.opencl import sources
from nacreous.opencl.device import Device
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of


def test_a_kernel_is_built_once(device: Device) -> None:
    """The same build is the same kernel; in another lane width it is another."""
    build = Build("film", Precision.SINGLE, 16, (("INCOHERENT", 0), ("PERIODIC", 0), ("MEDIA", 4)))
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
        "film", Precision.SINGLE, 4, (("INCOHERENT", 0), ("PERIODIC", 0), ("MEDIA", 4), ("FAULT", len(fault)))
    )
    with pytest.raises(DeviceError, match="kernel film does not build") as refused:
        kernel_of(device, build)
    assert f"complex.clh:{len(lines) - 1}:" in str(refused.value)
    assert told in str(refused.value)
