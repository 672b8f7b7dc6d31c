"""Every kernel compiles in every form it is built in, and a fault in one is found by file and line."""

import shutil
from pathlib import Path

import pytest

from nacreous.errors import DeviceError
from nacreous.opencl import sources
from nacreous.opencl.device import Device
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.opencl.sources import kernel_names

LANES = (1, 4, 8, 16)
FORMS = [
    pytest.param((("INCOHERENT", 0), ("PERIODIC", 0), ("TRANSMISSION", 1)), id="plain"),
    pytest.param((("INCOHERENT", 1), ("PERIODIC", 1), ("TRANSMISSION", 0)), id="thick and periodic"),
]
"""Each number in both of its values."""


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("lanes", LANES)
@pytest.mark.parametrize("precision", list(Precision))
@pytest.mark.parametrize("kernel", kernel_names())
def test_every_form_builds_without_a_warning(
    kernel: str, precision: Precision, lanes: int, form: tuple[tuple[str, int], ...], device: Device
) -> None:
    """The options hold -Werror and one language version, so that a warning is a refusal."""
    numbers = tuple((name, value) for name, value in form if name in NUMBERS[kernel])
    build = Build(kernel, precision, lanes, numbers)
    assert "-Werror" in build.options()
    assert kernel_of(device, build).function_name == kernel


NUMBERS = {
    "film": {"INCOHERENT", "PERIODIC"},
    "film_colour": {"INCOHERENT", "PERIODIC", "TRANSMISSION"},
    "film_ellipsometry": {"INCOHERENT", "PERIODIC"},
}
"""What the hosts pass to each kernel."""


def test_the_numbers_of_every_kernel_are_known() -> None:
    """A new kernel must join the test above."""
    assert sorted(NUMBERS) == kernel_names()


def test_a_kernel_is_built_once(device: Device) -> None:
    """The same build is the same object; another lane width is another."""
    build = Build("film", Precision.SINGLE, 16, (("INCOHERENT", 0), ("PERIODIC", 0)))
    assert kernel_of(device, build) is kernel_of(device, build)


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
    build = Build("film", Precision.SINGLE, 4, (("INCOHERENT", 0), ("PERIODIC", 0), ("FAULT", len(fault))))
    with pytest.raises(DeviceError, match="kernel film does not build") as refused:
        kernel_of(device, build)
    assert f"complex.clh:{len(lines) - 1}:" in str(refused.value)
    assert told in str(refused.value)
