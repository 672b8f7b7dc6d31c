"""One worker process, as its supervisor sees it: it is started, asked, listened to, and ended."""

import asyncio
import logging
import os
import signal
from asyncio.subprocess import PIPE, Process
from collections import deque
from collections.abc import Mapping, Sequence
from contextlib import suppress

from nacreous.engine.messages import Message, error_of, product_of, read, work_message
from nacreous.engine.work import Product, Work
from nacreous.opencl.tiles import Observer

__all__ = ["StartError", "WorkerFaultError", "WorkerLostError", "WorkerProcess"]

_BUFFER_BYTES = 2**20
_MOST_LINE_BYTES = 2000
_LAST_LINES = 3

_log = logging.getLogger("nacreous.engine.worker")


class WorkerLostError(Exception):
    """The worker has ended, or says what nobody understands."""


class WorkerFaultError(Exception):
    """The worker has met an error after which it is not to be trusted.

    Parameters
    ----------
    error : Exception
        What it met.
    code : int
        OpenCL's code of it, or 0.
    """

    def __init__(self, error: Exception, code: int) -> None:
        self.error, self.code = error, code
        super().__init__(str(error))


class StartError(Exception):
    """The worker is alive, and says why it cannot compute.

    Parameters
    ----------
    cause : str
        ``"device"``, where there is none, or ``"kernels"``.
    reason : str
    """

    def __init__(self, cause: str, reason: str) -> None:
        self.cause = cause
        super().__init__(reason)


class WorkerProcess:
    """A process that has been started; see `nacreous.engine.worker` for the other side."""

    def __init__(self, process: Process) -> None:
        self._process = process
        self._last_lines: deque[str] = deque(maxlen=_LAST_LINES)
        self._logging = asyncio.create_task(self._pass_on_lines())

    @classmethod
    async def spawn(cls, command: Sequence[str], environment: Mapping[str, str]) -> "WorkerProcess":
        """Start a process in a session of its own: a terminal's Ctrl-C is for the supervisor alone."""
        process = await asyncio.create_subprocess_exec(
            *command,
            stdin=PIPE,
            stdout=PIPE,
            stderr=PIPE,
            env=environment,
            start_new_session=True,
            limit=_BUFFER_BYTES,
        )
        return cls(process)

    @property
    def pid(self) -> int:
        """Process id."""
        return self._process.pid

    @property
    def killed(self) -> bool:
        """Whether SIGKILL has ended it, which comes from outside and not of what it did."""
        return self._process.returncode == -signal.SIGKILL

    async def ready(self) -> None:
        """Return when the worker takes work.

        Raises
        ------
        StartError
            It says that it cannot.
        WorkerLostError
        """
        message = await self._read()
        if message.kind != "ready":
            raise StartError(message.fields["cause"], message.fields["reason"])

    async def compute(self, work: Work, observer: Observer | None) -> Product:
        """Return what the worker makes of a work; where this is cancelled, the worker must be killed.

        Raises
        ------
        NacreousError
            As `nacreous.engine.work.compute` raises it; the worker is fit for more.
        WorkerFaultError, WorkerLostError
            It must be replaced.
        """
        await self._write(work_message(work))
        while (message := await self._read()).kind == "progress":
            if observer is not None:
                asyncio.get_running_loop().call_soon(observer, message.fields["fraction"])
        if message.kind == "product":
            return product_of(message)
        if message.kind == "fault":
            raise WorkerFaultError(error_of(message), message.fields["code"])
        raise error_of(message)

    def kill(self) -> None:
        """End the process, and the compiler that it may have started, at once."""
        with suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)

    async def close(self, seconds: float) -> None:
        """Ask the process to end, and end it where it does not within `seconds`.

        A supervision that is being cancelled ends here, where `asyncio.timeout` of Python before 3.11.3
        raises `CancelledError` in the place of its own error.
        """
        assert self._process.stdin is not None  # noqa: S101 - it has been started with PIPE
        self._process.stdin.close()
        try:
            _, running = await asyncio.wait({asyncio.create_task(self._process.wait())}, timeout=seconds)
            if running:
                self.kill()
        finally:
            await self.ended()

    async def ended(self) -> str:
        """Return how the process ended, once it has."""
        code = await self._process.wait()
        with suppress(TimeoutError):  # a compiler that it started may have its stderr still
            await asyncio.wait_for(self._logging, 1.0)
        how = f"was ended by {signal.Signals(-code).name}" if code < 0 else f"ended with {code}"
        return ": ".join(("the worker " + how, *list(self._last_lines)[-1:]))

    async def _write(self, message: Message) -> None:
        assert self._process.stdin is not None  # noqa: S101 - it has been started with PIPE
        try:
            self._process.stdin.writelines(message.pieces())
            await self._process.stdin.drain()
        except OSError as error:
            raise WorkerLostError("it takes nothing") from error

    async def _read(self) -> Message:
        assert self._process.stdout is not None  # noqa: S101 - it has been started with PIPE
        try:
            return await read(self._process.stdout)
        except (EOFError, OSError, ValueError) as error:
            self.kill()
            raise WorkerLostError("it has ended in mid-work") from error

    async def _pass_on_lines(self) -> None:
        """Log what the worker, its driver and its compilers print."""
        assert self._process.stderr is not None  # noqa: S101 - it has been started with PIPE
        rest = b""
        while piece := await self._process.stderr.read(_BUFFER_BYTES):
            *lines, rest = (rest + piece).split(b"\n")
            for line in lines:
                self._log_line(line)
            if len(rest) > _MOST_LINE_BYTES:
                self._log_line(rest)
                rest = b""
        self._log_line(rest)

    def _log_line(self, line: bytes) -> None:
        text = line[:_MOST_LINE_BYTES].decode(errors="replace").strip()
        if text:
            self._last_lines.append(text)
            _log.info("%s", text)
