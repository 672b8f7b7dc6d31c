"""Devices: finding, choosing and opening them, and where their kernels are kept."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from nacreous.errors import DeviceError
from nacreous.opencl.device import list_devices, open_device
from nacreous.opencl.precision import Precision

FIRST_FILM = "from nacreous.tables.self_test import run_self_test; assert run_self_test().passed"


def _run(code: str, **environment: str) -> subprocess.CompletedProcess[str]:
    clean = {name: value for name, value in os.environ.items() if name != "POCL_CACHE_DIR"}
    return subprocess.run(
        [sys.executable, "-c", code], env=clean | environment, capture_output=True, text=True, check=False
    )


def test_pocl_is_found() -> None:
    """PoCL's wheel is a dependency, so there is a CPU that computes in double precision."""
    found = [info for info in list_devices() if "Portable Computing Language" in info.platform]
    assert found
    assert found[0].kind == "cpu"
    assert found[0].double
    assert found[0].lanes in (1, 4, 8, 16)


def test_a_device_is_chosen_by_number_or_by_name() -> None:
    """All of them name the first PoCL device; the same selector gives the same device again."""
    first = next(info for info in list_devices() if "Portable Computing Language" in info.platform)
    chosen = [open_device(selector) for selector in (None, first.selector, "portable computing")]
    assert {device.info for device in chosen} == {first}
    assert open_device(first.selector) is chosen[1]


def test_the_environment_chooses(monkeypatch: pytest.MonkeyPatch) -> None:
    """NACREOUS_DEVICE counts where no selector is given."""
    monkeypatch.setenv("NACREOUS_DEVICE", "no such device")
    with pytest.raises(DeviceError, match=r"NACREOUS_DEVICE: expected one of 0:0 .*got 'no such device'"):
        open_device()


def test_double_precision_has_narrower_lanes() -> None:
    """A register holds half as many numbers of twice the bits."""
    device = open_device()
    assert device.lanes(Precision.DOUBLE) <= device.lanes(Precision.SINGLE)


def test_no_platform_is_one_clear_message(tmp_path: Path) -> None:
    """With an OpenCL loader that finds no driver, the message says what to install."""
    code = (
        "from nacreous.opencl.device import list_devices\n"
        "from nacreous.errors import DeviceError\n"
        "try: print(list_devices())\n"
        "except DeviceError as error: print(error)"
    )
    done = _run(code, OCL_ICD_VENDORS=str(tmp_path), OPENCL_VENDOR_PATH=str(tmp_path))
    assert done.returncode == 0, done.stderr
    assert "pip install pocl-binary-distribution" in done.stdout or "Portable Computing" in done.stdout


def test_kernels_are_kept_in_a_folder_of_our_own(tmp_path: Path) -> None:
    """XDG Base Directory: below $XDG_CACHE_HOME; another program's entry would end the process."""
    done = _run(
        "import os; from nacreous.opencl.device import list_devices; list_devices();"
        "print(os.environ['POCL_CACHE_DIR'])",
        XDG_CACHE_HOME=str(tmp_path),
    )
    folder = Path(done.stdout.strip())
    assert folder.is_relative_to(tmp_path / "nacreous"), done.stderr
    assert folder.is_dir()


def test_an_unwritable_home_is_no_obstacle(tmp_path: Path) -> None:
    """A cache folder that is a file: kernels are compiled in a temporary folder, which is gone afterwards."""
    (tmp_path / "nacreous").write_text("in the way")
    temporary = tmp_path / "tmp"
    temporary.mkdir()
    done = _run(FIRST_FILM, XDG_CACHE_HOME=str(tmp_path), TMPDIR=str(temporary))
    assert done.returncode == 0, done.stderr
    assert list(temporary.glob("nacreous-kernels-*")) == []


def test_a_missing_linker_is_one_clear_message(tmp_path: Path) -> None:
    """PoCL ends the process where it cannot link; we say so first."""
    code = (
        "from nacreous.opencl.device import open_device\n"
        "from nacreous.errors import DeviceError\n"
        "try: open_device()\n"
        "except DeviceError as error: print(error)"
    )
    done = _run(code, PATH=str(tmp_path))
    assert done.returncode == 0, done.stderr
    assert "install binutils and gcc" in done.stdout
