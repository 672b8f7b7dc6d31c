"""Where a worker's PoCL keeps compiled kernels between starts: a folder that no other process uses.

PoCL trusts its cache: a damaged file, a full disk or another process that writes the same file end it with a
signal. So the folders are numbered, each is locked by the one process that uses it (flock, which the system
gives back however the process ends), and a new start takes the first that is free: warm where one was used
before, its own where six start at once. Where none can be used, kernels are compiled into a temporary folder.
"""

import fcntl
import hashlib
import os
import platform
import shutil
import tempfile
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from nacreous.errors import DeviceError, reason
from nacreous.opencl.device import cache_folder

__all__ = ["KernelCache", "take_cache", "take_temporary_cache"]

_FREE_BYTES = 32 * 2**20
"""Kernels of all quantities, in both precisions, take about a third of it."""
_MOST_FOLDERS = 32
_TEMPORARY = (None, "/dev/shm")  # noqa: S108 - mkdtemp makes a folder that is this user's alone
"""Where temporary folders are tried: where the system has them, and in memory, which is no full disk."""
_LITTER = "tempfile*"
"""What PoCL leaves in the folder where it is killed while it compiles."""


@dataclass(frozen=True)
class KernelCache:
    """A folder of kernels that belongs to this process until it is released.

    Parameters
    ----------
    folder : Path
    lock : int, optional
        File descriptor whose lock makes it so; a folder without one is removed on release.
    """

    folder: Path
    lock: int | None = None

    @property
    def usable(self) -> bool:
        """Whether kernels can be written there now."""
        return not _fault(self.folder)

    def wipe(self) -> None:
        """Remove all kernels; what cannot be removed stays."""
        for path in self.folder.glob("*"):
            shutil.rmtree(path, ignore_errors=True)
            _remove(path)

    def release(self) -> None:
        """Let others have the folder."""
        if self.lock is None:
            shutil.rmtree(self.folder, ignore_errors=True)
        else:
            os.close(self.lock)


def take_cache(base: Path | None = None) -> KernelCache:
    """Return a folder below `base` that is kept between starts, or a temporary one where that cannot be.

    Parameters
    ----------
    base : Path, optional
        The user's folder of caches, without one.

    Raises
    ------
    DeviceError
        No folder can be written.
    """
    parent = (base or cache_folder().parent) / f"workers-{cache_folder().name}-{_cpu()}"
    for number in range(_MOST_FOLDERS):
        folder = parent / str(number)
        if _fault(folder):
            break
        if (lock := _locked(folder.with_suffix(".lock"))) is not None:
            for path in folder.glob(_LITTER):
                _remove(path)
            return KernelCache(folder, lock)
    return take_temporary_cache()


def take_temporary_cache() -> KernelCache:
    """Return an empty folder that is gone when it is released; raises `DeviceError` where there is none."""
    faults: list[str] = []
    for parent in _TEMPORARY:
        try:
            folder = Path(tempfile.mkdtemp(prefix="nacreous-kernels-", dir=parent))
        except OSError as error:
            faults.append(f"{error.filename or parent}: {reason(error)}")
            continue
        if not (fault := _fault(folder)):
            return KernelCache(folder)
        faults.append(fault)
        shutil.rmtree(folder, ignore_errors=True)
    raise DeviceError(f"no folder for compiled kernels: {'; '.join(faults)}; make one of them writable")


def _fault(folder: Path) -> str:
    """Return why kernels cannot be written into a folder, which is made; nothing where they can."""
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        free = shutil.disk_usage(folder).free
        with tempfile.TemporaryFile(dir=folder) as probe:
            probe.write(b"kernel")
    except OSError as error:
        return f"{folder}: {reason(error)}"
    return "" if free >= _FREE_BYTES else f"{folder}: {free / 2**20:.1f} MiB free"


def _locked(path: Path) -> int | None:
    """Return a file descriptor that holds the lock; nothing where another process has it."""
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(descriptor)
        return None
    return descriptor


def _remove(path: Path) -> None:
    with suppress(OSError):
        path.unlink()


def _cpu() -> str:
    """Return a short name of this machine's processor: kernels hold its instructions."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace")
    except OSError:
        text = platform.processor()
    facts = sorted(
        {line for line in text.splitlines() if line.startswith(("model name", "flags", "Features"))}
    )
    digest = hashlib.sha256("\n".join(facts).encode()).hexdigest()
    return f"{platform.machine()}-{digest[:12]}"
