"""How much memory this process can still have: what the machine, its group and its own limit leave."""

import re
import resource
from pathlib import Path

__all__ = ["cap_address_space", "headroom_bytes"]

_KIB = 2**10
_GROUP = Path("/sys/fs/cgroup")


def cap_address_space(limit_bytes: int) -> None:
    """Let this process have so much address space and no more: what asks for more gets a MemoryError."""
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    allowed = limit_bytes if hard == resource.RLIM_INFINITY else min(limit_bytes, hard)
    resource.setrlimit(resource.RLIMIT_AS, (allowed, hard))


def headroom_bytes() -> int | None:
    """Return the bytes that this process can still allocate; nothing where no limit is known."""
    limits = (_address_space_left(), _machine_left(), _group_left())
    return min((left for left in limits if left is not None), default=None)


def _address_space_left() -> int | None:
    soft, _ = resource.getrlimit(resource.RLIMIT_AS)
    used = _kib_of(Path("/proc/self/status"), "VmSize")
    return None if soft == resource.RLIM_INFINITY or used is None else max(0, soft - used)


def _machine_left() -> int | None:
    return _kib_of(Path("/proc/meminfo"), "MemAvailable")


def _group_left() -> int | None:
    """Return what the limit of a container leaves (Linux, control groups version 2).

    Memory that caches files does not count: the system gives it up.
    """
    limit = _text(_GROUP / "memory.max").strip()
    used = re.search(r"^anon (\d+)$", _text(_GROUP / "memory.stat"), re.MULTILINE)
    return max(0, int(limit) - int(used[1])) if limit.isdecimal() and used else None


def _kib_of(path: Path, name: str) -> int | None:
    match = re.search(rf"^{name}:\s*(\d+) kB$", _text(path), re.MULTILINE)
    return int(match[1]) * _KIB if match else None


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="ascii", errors="replace")
    except OSError:
        return ""
