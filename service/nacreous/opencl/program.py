"""Programs: a kernel's source built for a device, a precision and a lane width.

A program is built once a process and kept; PoCL keeps its own compiled form between processes, in the cache
folder that `nacreous.opencl.device` gives it.
"""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from nacreous.errors import DeviceError
from nacreous.opencl.device import Device
from nacreous.opencl.precision import Precision
from nacreous.opencl.sources import complete_source

__all__ = ["Build", "kernel_of"]

_OPTIONS = ("-cl-std=CL1.2", "-Werror")


@dataclass(frozen=True)
class Build:
    """One way to build one kernel.

    Parameters
    ----------
    kernel : str
        Name of the kernel, its file and its function.
    precision : Precision
    lanes : int
        Wavelengths a work-item: 16, 8, 4 or 1.
    numbers : tuple of (str, int)
        Further numbers that the source asks for, such as ``("INCOHERENT", 0)``.
    """

    kernel: str
    precision: Precision
    lanes: int
    numbers: tuple[tuple[str, int], ...] = field(default=())

    def options(self) -> list[str]:
        """Return the compiler options: numbers only, the text is never assembled."""
        numbers = (("REAL", self.precision.value), ("LANES", self.lanes), *self.numbers)
        return [*_OPTIONS, *(f"-D{name}={value}" for name, value in numbers)]


_KEPT: dict[tuple[int, Build], Any] = {}
"""Kernels by device and build: building takes a second, and a process wants few of them."""


def kernel_of(device: Device, build: Build) -> Any:  # noqa: ANN401 - pyopencl is untyped
    """Return the built kernel; the first call for a build compiles it.

    Raises
    ------
    DeviceError
        The compiler refuses the source; the message has its file and line.
    """
    key = (id(device), build)
    if key not in _KEPT:
        _KEPT[key] = _built(device, build)
    return _KEPT[key]


def _built(device: Device, build: Build) -> Any:  # noqa: ANN401 - pyopencl is untyped
    import pyopencl as cl

    try:
        with _quiet_compiler():
            program = cl.Program(device.context, complete_source(build.kernel)).build(build.options())
        return cl.Kernel(program, build.kernel)
    except cl.Error as error:
        message = f"kernel {build.kernel} does not build on {device.info.name}: {error}"
        raise DeviceError(message) from error


@contextmanager
def _quiet_compiler() -> Iterator[None]:
    """Mute pyopencl's note that the compiler said something: what is wrong is an error (-Werror)."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield
