"""The worker: a process that computes one work after the other, and may end at any time.

Its supervisor, `nacreous.engine.worker_engine`, has started it with two pipes. It answers them alone: what a
driver prints goes to stderr. It ends when the supervisor closes its pipe, or is gone.
"""

import ctypes
import fcntl
import logging
import os
import signal
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from typing import BinaryIO

from nacreous.engine.memory import cap_address_space, headroom_bytes
from nacreous.engine.messages import (
    Message,
    error_message,
    fault_message,
    product_message,
    receive,
    send,
    work_of,
)
from nacreous.engine.work import Product, Work, compute
from nacreous.errors import BudgetError, DeviceError, NacreousError, reason
from nacreous.formats.names import FormatName
from nacreous.opencl.budget import byte_budget
from nacreous.opencl.device import open_device
from nacreous.opencl.tiles import Observer
from nacreous.tables.self_test import run_self_test
from nacreous.tables.spec import Spec

__all__ = ["MEMORY_CAP", "PARENT", "Compute", "serve"]

Compute = Callable[[Work, Observer], Product]

MEMORY_CAP = "NACREOUS_WORKER_MEMORY"
"""Environment variable: bytes of address space that the worker may have."""
PARENT = "NACREOUS_WORKER_PARENT"
"""Environment variable: process id of the supervisor."""

_PR_SET_PDEATHSIG = 1
"""Of <linux/prctl.h>: a signal that the system sends when the thread that started this process ends."""
_OPENCL = "pyopencl"
"""Where the errors of OpenCL are from that nobody has made a `DeviceError` of."""
_PIPE_BYTES = 2**20
"""The most that Linux gives without asking: files cross in fewer pieces."""
_PROGRESS_S = 0.05
_COPIES = 3
"""What a table takes for each byte that is counted: it is assembled, converted and written from copies."""
_WARM_UP = {
    "stack": {
        "incident": "air",
        "substrate": {"n": 1.5},
        "layers": [{"material": {"n": 2.0}, "thickness_nm": 420}],
    },
    "table": {"cos_theta": 4, "thickness_scale": {"start": 0.9, "stop": 1.1, "count": 4}},
}

_log = logging.getLogger(__name__)


def serve(compute: Compute = compute) -> None:
    """Make ready, say so, and do what is asked until the supervisor closes the pipe or is gone."""
    logging.basicConfig(stream=sys.stderr, format="%(levelname)s %(name)s: %(message)s")
    requests, replies = _take_pipes()
    _end_with_parent()
    if cap := os.environ.get(MEMORY_CAP):
        cap_address_space(int(cap))
    with suppress(BrokenPipeError):
        send(replies, _made_ready())
        while (message := receive(requests)) is not None:
            send(replies, _answer(message, compute, replies))


def _take_pipes() -> tuple[BinaryIO, BinaryIO]:
    """Return the pipes, moved to where neither a driver's printf nor a compiler that it starts has them."""
    requests, replies = os.dup(0), os.dup(1)  # neither is inherited by other programs
    with open(os.devnull) as nothing:  # noqa: PTH123 - a name of the system, no path
        os.dup2(nothing.fileno(), 0)
    os.dup2(2, 1)
    with suppress(OSError, AttributeError):  # no pipe but a socket, or no Linux
        fcntl.fcntl(replies, fcntl.F_SETPIPE_SZ, _PIPE_BYTES)
    return os.fdopen(requests, "rb"), os.fdopen(replies, "wb")


def _end_with_parent() -> None:
    """Let the system end this process with its supervisor, and nothing that is sent to a whole group."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.environ.get(PARENT, str(os.getppid())) != str(os.getppid()):
            sys.exit(0)  # it ended before the system was asked


def _made_ready() -> Message:
    """Open the device, prove it, compile what most works need; say ready, or why not."""
    try:
        open_device()
    except NacreousError as error:
        return Message("failed", {"cause": "device", "reason": str(error)})
    try:
        if fault := _self_test_fault():
            return Message("failed", {"cause": "kernels", "reason": fault})
        _warm_up()
    except NacreousError as error:
        return Message("failed", {"cause": "kernels", "reason": str(error)})
    _fit_budget()
    return Message("ready", {"device": open_device().info.name})


def _warm_up() -> None:
    """Compute a small lookup texture: what it compiles and imports, most works need."""
    with suppress(BudgetError):  # of an operator who allows even less
        compute(Work(Spec.model_validate(_WARM_UP), FormatName.EXR))


def _self_test_fault() -> str:
    test = run_self_test()
    if test.passed:
        return ""
    return (
        f"the device computes {test.cases} known stacks with errors of {test.worst_single:.2g} in single and "
        f"{test.worst_double:.2g} in double precision, and {test.nonfinite} values that are not finite"
    )


def _fit_budget() -> None:
    """Lower the byte budget to what memory there is: a table too large is refused, before it is begun."""
    headroom = headroom_bytes()
    if headroom is not None and headroom // _COPIES < byte_budget():
        os.environ["NACREOUS_BYTE_BUDGET"] = str(max(1, headroom // _COPIES))


def _answer(message: Message, compute: Compute, replies: BinaryIO) -> Message:
    """Return what comes of a work, or how it failed."""
    try:
        return product_message(compute(work_of(message), _progress_to(replies)))
    except BrokenPipeError:
        raise  # the supervisor is gone
    except Exception as error:  # noqa: BLE001 - whatever it is, the supervisor hears of it
        return _failure(error)


def _failure(error: Exception) -> Message:
    """Return what tells of a refusal, or of a fault after which this process is not to be trusted."""
    if isinstance(error.__cause__, OSError):
        return fault_message(DeviceError(f"the worker cannot write: {reason(error.__cause__)}"), 0)
    if isinstance(error, NacreousError) and not isinstance(error, DeviceError):
        return error_message(error)
    _log.error("fault", exc_info=error)
    return fault_message(_as_told(error), getattr(error.__cause__ or error, "code", 0))


def _as_told(error: Exception) -> Exception:
    """Return what the caller is told of a fault."""
    if isinstance(error, DeviceError):
        return error
    if isinstance(error, MemoryError):
        return DeviceError("the worker's memory does not suffice for this table")
    if type(error).__module__.startswith(_OPENCL):
        return DeviceError(f"the device failed: {error}")
    return RuntimeError(f"{type(error).__name__}: {error}")


def _progress_to(replies: BinaryIO) -> Observer:
    """Return an observer that tells the supervisor, at most every 50 ms."""
    told = float("-inf")

    def tell(fraction: float) -> None:
        nonlocal told
        if time.monotonic() - told >= _PROGRESS_S:
            told = time.monotonic()
            send(replies, Message("progress", {"fraction": fraction}))

    return tell


if __name__ == "__main__":
    serve()
