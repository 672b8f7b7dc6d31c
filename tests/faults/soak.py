"""How often a fault is injected: in every test run a little, in a soak as often as the promise says."""

import os

__all__ = ["scale"]


def scale(short: int, full: int) -> int:
    """Return `full` where the environment has ``NACREOUS_SOAK=1``, and `short` otherwise."""
    return full if os.environ.get("NACREOUS_SOAK") == "1" else short
