"""The service in a process of its own, as `nacreous serve` starts it, on a port that is free."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx

__all__ = ["Served", "serving"]

PROGRAM = (sys.executable, "-c", "from nacreous.cli.app import main; main()")
READY_SECONDS = 120.0
_LISTENING = '"event": "listening"'


@dataclass
class Served:
    """A running service.

    Parameters
    ----------
    process : Popen
    lines : list of str
        What it has logged so far.
    url : str
        Where it listens.
    """

    process: subprocess.Popen[str]
    lines: list[str] = field(default_factory=list)
    url: str = ""
    _reader: threading.Thread | None = None

    @property
    def address(self) -> tuple[str, int]:
        """Host and port."""
        parsed = httpx.URL(self.url)
        return parsed.host, parsed.port or 80

    def read_log(self) -> None:
        """Keep the log, and find in it where the service listens."""
        assert self.process.stderr is not None
        listening = threading.Event()

        def read() -> None:
            for line in self.process.stderr or ():
                self.lines.append(line)
                if _LISTENING in line:
                    self.url = json.loads(line)["url"]
                    listening.set()
            listening.set()

        self._reader = threading.Thread(target=read, daemon=True)
        self._reader.start()
        assert listening.wait(READY_SECONDS)
        assert self.url, "".join(self.lines)

    def await_ready(self) -> None:
        """Wait until tables are computed."""
        end = time.monotonic() + READY_SECONDS
        with httpx.Client(base_url=self.url) as client:
            while client.get("/readyz").status_code != 200:
                assert time.monotonic() < end, client.get("/readyz").text
                threading.Event().wait(0.05)

    def stop(self, number: signal.Signals = signal.SIGTERM, within: float = 30.0) -> int:
        """Send a signal and return the exit code."""
        self.process.send_signal(number)
        code = self.process.wait(within)
        if self._reader is not None:
            self._reader.join(within)
        return code


@contextmanager
def serving(store: Path, **settings: Any) -> Iterator[Served]:  # noqa: ANN401 - values of settings
    """Run ``nacreous serve`` with these settings; it is killed at the end where it still runs."""
    given = {f"NACREOUS_{name.upper()}": str(value) for name, value in settings.items()}
    environment = {**os.environ, "NACREOUS_PORT": "0", "NACREOUS_STORE": str(store), **given}
    process = subprocess.Popen(
        [*PROGRAM, "serve"], env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    )
    served = Served(process)
    try:
        served.read_log()
        yield served
    finally:
        if process.poll() is None:
            process.kill()
        process.wait()
        if served._reader is not None:
            served._reader.join()
        if process.stderr is not None:
            process.stderr.close()
