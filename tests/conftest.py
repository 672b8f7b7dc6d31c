"""What every test may ask for."""

import pytest

from nacreous.opencl.device import Device, open_device


@pytest.fixture(scope="session")
def device() -> Device:
    """Return the device that `open_device` chooses by itself."""
    return open_device()
