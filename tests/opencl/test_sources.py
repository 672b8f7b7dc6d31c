"""Kernel sources: includes and line numbers."""

import re
from pathlib import Path

import pytest

from nacreous.errors import DeviceError
from nacreous.opencl import sources
from nacreous.opencl.device import Device
from nacreous.opencl.precision import Precision
from nacreous.opencl.program import Build, kernel_of
from nacreous.paths import KERNELS


def test_every_include_is_expanded() -> None:
    """No include is left, and every header that is named is there."""
    for kernel in sources.kernel_names():
        text = sources.complete_source(kernel)
        assert "#include" not in text
        for header in re.findall(r'#include "(\S+)"', (KERNELS / f"{kernel}.cl").read_text()):
            assert f'#line 1 "{header}"' in text


def test_every_header_belongs_to_a_kernel() -> None:
    """A header that no kernel includes is dead."""
    text = "".join(map(sources.complete_source, sources.kernel_names()))
    assert all(f'"{header.name}"' in text for header in KERNELS.glob("*.clh"))


def test_a_compile_error_names_file_and_line(
    device: Device, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The third line of a header that the second line of a kernel includes."""
    (tmp_path / "broken.clh").write_text("// one\n// two\nint f(void) { return nonsense; }\n")
    (tmp_path / "broken.cl").write_text('// first\n#include "broken.clh"\nkernel void broken(void) {}\n')
    monkeypatch.setattr(sources, "KERNELS", tmp_path)
    with pytest.raises(DeviceError, match=r"broken\.clh:3:.*nonsense"):
        kernel_of(device, Build("broken", Precision.SINGLE, 1))


def test_lines_after_an_include_count_on(
    device: Device, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An error in the kernel's own fourth line, two lines below the include."""
    (tmp_path / "fine.clh").write_text("// one\n// two\n")
    text = '// first\n#include "fine.clh"\nkernel void late(void) {\n    nonsense();\n}\n'
    (tmp_path / "late.cl").write_text(text)
    monkeypatch.setattr(sources, "KERNELS", tmp_path)
    with pytest.raises(DeviceError, match=r"late\.cl:4:.*nonsense"):
        kernel_of(device, Build("late", Precision.SINGLE, 1))


def test_the_hash_is_of_the_complete_text(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A change in a header changes the hash of the kernels."""
    (tmp_path / "part.clh").write_text("// one\n")
    (tmp_path / "whole.cl").write_text('#include "part.clh"\n')
    monkeypatch.setattr(sources, "KERNELS", tmp_path)
    before = sources.kernels_hash()
    (tmp_path / "part.clh").write_text("// two\n")
    assert sources.kernels_hash() != before
