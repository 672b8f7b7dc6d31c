"""OpenCL devices: which there are, which one computes, and how wide its lanes are.

PoCL on the CPU is the default; a GPU is used where it is asked for, with ``NACREOUS_DEVICE`` or a selector.
"""

import functools
import os
import shutil
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from types import ModuleType
from typing import Any

from nacreous.errors import DeviceError
from nacreous.opencl.precision import Precision
from nacreous.opencl.register_width import lane_width

__all__ = ["Device", "DeviceInfo", "cache_folder", "list_devices", "open_device"]

_INSTALL = "install PoCL with `pip install pocl-binary-distribution`, or Intel's runtime with nacreous[intel]"
_POCL = "Portable Computing Language"
"""Name of PoCL's platform. It ends the process if it cannot link, so that is asked first."""


@dataclass(frozen=True)
class DeviceInfo:
    """What a person chooses a device by.

    Parameters
    ----------
    selector : str
        ``"<platform number>:<device number>"``, which `open_device` and ``NACREOUS_DEVICE`` take.
    platform, name, version : str
        As the driver gives them.
    kind : str
        ``"cpu"``, ``"gpu"`` or ``"other"``.
    lanes : int
        Wavelengths that one work-item evaluates in single precision.
    double : bool
        Whether it computes in double precision.
    """

    selector: str
    platform: str
    name: str
    version: str
    kind: str
    lanes: int
    double: bool


@dataclass(frozen=True, eq=False)
class Device:
    """An opened device: its context, and the one queue that all its work goes through."""

    info: DeviceInfo
    context: Any
    queue: Any

    def lanes(self, precision: Precision) -> int:
        """Lane width for numbers of `precision`: the device's vector width."""
        return lane_width(self.queue.device, precision)

    @property
    def memory_bytes(self) -> int:
        """The largest single buffer that the device gives."""
        return int(self.queue.device.max_mem_alloc_size)


def cache_folder() -> Path:
    """Folder of compiled kernels, private to Nacreous and to this version of PoCL."""
    import platformdirs

    try:
        runtime = f"pocl-{version('pocl-binary-distribution')}"
    except PackageNotFoundError:
        runtime = "opencl"
    return Path(platformdirs.user_cache_dir("nacreous")) / runtime


def list_devices() -> list[DeviceInfo]:
    """Every OpenCL device of every platform, in the order of the drivers.

    Raises
    ------
    DeviceError
        No OpenCL platform is installed.
    """
    return [info for info, _ in _devices()]


def open_device(selector: str | None = None) -> Device:
    """Open a device; the same selector gives the same device again.

    Parameters
    ----------
    selector : str, optional
        ``"0:0"`` as `list_devices` names it, or a part of the platform's or the device's name. Without one
        ``NACREOUS_DEVICE`` counts, and without that the first PoCL device, else the first of all.

    Raises
    ------
    DeviceError
        There is no such device, or it cannot be opened.
    """
    return _open(selector or os.environ.get("NACREOUS_DEVICE") or None)


@functools.cache
def _open(selector: str | None) -> Device:
    info, device = _choose(selector)
    if _POCL in info.platform and shutil.which("ld") is None:
        raise DeviceError("PoCL links kernels with ld, which is not installed; install binutils and gcc")
    cl = _pyopencl()
    try:
        context = cl.Context([device])
        return Device(info, context, cl.CommandQueue(context))
    except cl.Error as error:
        raise DeviceError(f"OpenCL device {info.selector} ({info.name}) cannot be opened: {error}") from error


def _choose(selector: str | None) -> tuple[DeviceInfo, Any]:
    found = _devices()
    if selector is None:
        return next((pair for pair in found if _POCL in pair[0].platform), found[0])
    for info, device in found:
        if selector == info.selector or selector.casefold() in f"{info.platform} {info.name}".casefold():
            return info, device
    known = ", ".join(f"{info.selector} ({info.name})" for info, _ in found)
    raise DeviceError(f"NACREOUS_DEVICE: expected one of {known}, got {selector!r}")


def _devices() -> list[tuple[DeviceInfo, Any]]:
    cl = _pyopencl()
    try:
        platforms = cl.get_platforms()
    except cl.LogicError as error:
        raise DeviceError(f"no OpenCL platform found ({error}); {_INSTALL}") from error
    found = [
        (_describe(f"{p}:{d}", device), device)
        for p, platform in enumerate(platforms)
        for d, device in enumerate(_platform_devices(cl, platform))
    ]
    if not found:
        raise DeviceError(f"no OpenCL device found; {_INSTALL}")
    return found


def _platform_devices(cl: ModuleType, platform: Any) -> list[Any]:  # noqa: ANN401 - pyopencl is untyped
    try:
        return list(platform.get_devices())
    except cl.RuntimeError:  # a driver without a device, such as a GPU's on a machine that has none
        return []


def _describe(selector: str, device: Any) -> DeviceInfo:  # noqa: ANN401 - pyopencl is untyped
    cl = _pyopencl()
    kinds = {cl.device_type.CPU: "cpu", cl.device_type.GPU: "gpu"}
    kind = next((name for bit, name in kinds.items() if device.type & bit), "other")
    lanes = lane_width(device, Precision.SINGLE)
    double = bool(device.double_fp_config)
    return DeviceInfo(selector, device.platform.name, device.name, device.version, kind, lanes, double)


@functools.cache
def _pyopencl() -> ModuleType:
    """Import pyopencl with caches that are ours alone: a foreign or corrupt entry would end the process."""
    os.environ.setdefault("PYOPENCL_NO_CACHE", "1")
    if "POCL_CACHE_DIR" not in os.environ:
        os.environ["POCL_CACHE_DIR"] = str(_usable_cache_folder())
    import pyopencl

    return pyopencl


def _usable_cache_folder() -> Path:
    folder = cache_folder()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return _temporary_folder()
    return folder if os.access(folder, os.W_OK) else _temporary_folder()


def _temporary_folder() -> Path:
    """Where kernels are compiled on a machine whose home cannot be written; gone with the process."""
    import atexit
    import tempfile

    folder = Path(tempfile.mkdtemp(prefix="nacreous-kernels-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder
