"""What a supervisor and its worker are given."""

import sys
from dataclasses import dataclass
from pathlib import Path

__all__ = ["WorkerSettings"]


@dataclass(frozen=True)
class WorkerSettings:
    """How tables are computed in a process of their own.

    Parameters
    ----------
    deadline_s : float
        How long a worker may compute for one work.
    queue_length : int
        Works that may wait beside the one in hand.
    grace_s : float
        How long `stop` lets the work in hand go on.
    start_s : float
        How long a worker may take until it is ready: it compiles kernels on its first start.
    cache_folder : Path, optional
        Where compiled kernels are kept between starts; the user's cache folder, without one.
    device : str, optional
        A selector, as `nacreous.opencl.device.open_device` takes it.
    byte_budget : int, optional
        Bytes that a table and its buffers may take; ``NACREOUS_BYTE_BUDGET``, without it. A machine with
        little memory has less.
    memory_cap : int, optional
        Bytes of address space that the worker may have; as much as there is, without it.
    refused_s : float
        How long a work that has ended two workers is refused.
    command : tuple of str
        What is started. -P keeps the folder that the service is started in off the path of modules.
    """

    deadline_s: float = 60.0
    queue_length: int = 64
    grace_s: float = 15.0
    start_s: float = 60.0
    cache_folder: Path | None = None
    device: str | None = None
    byte_budget: int | None = None
    memory_cap: int | None = None
    refused_s: float = 600.0
    command: tuple[str, ...] = (sys.executable, "-P", "-m", "nacreous.engine.worker")
