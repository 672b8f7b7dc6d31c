"""``nacreous devices``: what can compute."""

from dataclasses import asdict
from typing import TYPE_CHECKING

from nacreous.cli.arguments import AsJson

if TYPE_CHECKING:
    from nacreous.opencl.device import DeviceInfo

__all__ = ["device_row", "devices"]


def devices(*, as_json: AsJson = False) -> None:
    """List the OpenCL devices.

    NACREOUS_DEVICE takes what the first column holds, or a part of a name.
    """
    from nacreous.cli.listing import print_columns, print_json_lines
    from nacreous.opencl.device import list_devices

    found = list_devices()
    if as_json:
        print_json_lines(map(asdict, found))
    else:
        print_columns(map(device_row, found))


def device_row(device: "DeviceInfo") -> dict[str, str]:
    """Return what a person reads about a device."""
    return {
        "selector": device.selector,
        "kind": device.kind,
        "lanes": f"{device.lanes} lanes",
        "double": "single and double" if device.double else "single precision only",
        "name": f"{device.name} ({device.platform}, {device.version.strip()})",
    }
