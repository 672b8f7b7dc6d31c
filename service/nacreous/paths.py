"""Where the parts that are not Python lie: beside the package in a checkout, inside it once installed."""

from pathlib import Path

__all__ = ["KERNELS"]

_PACKAGE = Path(__file__).parent


def _shipped(name: str) -> Path:
    installed = _PACKAGE / name
    return installed if installed.is_dir() else _PACKAGE.parents[1] / name


KERNELS = _shipped("kernels")
