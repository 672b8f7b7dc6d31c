"""The lane widths that tests compute in: all that the compiler of this machine has registers for."""

from nacreous.opencl.device import Device
from nacreous.opencl.precision import Precision
from nacreous.opencl.register_width import LANE_WIDTHS


def lane_widths(device: Device, precision: Precision) -> tuple[int, ...]:
    """Return 1, 4, 8 and 16, as far as the device goes."""
    return tuple(width for width in sorted(LANE_WIDTHS) if width <= device.lanes(precision))
