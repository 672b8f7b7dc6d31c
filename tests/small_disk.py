"""A real small disk: a tmpfs, which only the superuser can mount."""

import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

__all__ = ["filled", "mounted", "remounted_read_only"]

_MOUNT, _UNMOUNT = shutil.which("mount") or "mount", shutil.which("umount") or "umount"


@contextmanager
def mounted(folder: Path, size_bytes: int) -> Iterator[Path]:
    """Mount a new tmpfs of a size at `folder`, which is made; skips the test where that is not permitted."""
    folder.mkdir()
    options = f"size={size_bytes},mode=0777"
    done = subprocess.run(
        [_MOUNT, "-t", "tmpfs", "-o", options, "tmpfs", folder], capture_output=True, text=True
    )
    if done.returncode:
        pytest.skip(f"a tmpfs cannot be mounted: {done.stderr.strip()}")
    try:
        yield folder
    finally:
        subprocess.run([_UNMOUNT, folder], check=True)


def filled(folder: Path) -> Path:
    """Return a file that takes all the room that is left on a folder's disk."""
    path = folder / "filling"
    with path.open("wb", buffering=0) as file:
        try:
            while file.write(bytes(4096)):
                pass
        except OSError:
            return path
    raise AssertionError(f"{folder} has no end")


def remounted_read_only(folder: Path) -> None:
    """Take away the permission to write to a mounted disk."""
    subprocess.run([_MOUNT, "-o", "remount,ro", folder], check=True)
