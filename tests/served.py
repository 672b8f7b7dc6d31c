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
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import httpx

__all__ = ["Served", "serving"]

PROGRAM = (sys.executable, "-c", "from nacreous.cli.app import main; main()")
READY_SECONDS = 120.0
_LISTENING = '"event": "listening"'


@dataclass(frozen=True)
class Served:
    """A running service.

    Parameters
    ----------
    process : Popen
    log : Path
        Where it logs to: a file, so that nobody has to read along.
    """

    process: subprocess.Popen[bytes]
    log: Path

    @property
    def lines(self) -> list[str]:
        """What it has logged so far."""
        return self.log.read_text().splitlines()

    @cached_property
    def url(self) -> str:
        """Where it listens, as it says once it does."""
        end = time.monotonic() + READY_SECONDS
        while not (found := [line for line in self.lines if _LISTENING in line and line.endswith("}")]):
            assert self.process.poll() is None, self.log.read_text()
            assert time.monotonic() < end
            threading.Event().wait(0.02)
        return str(json.loads(found[0])["url"])

    @property
    def address(self) -> tuple[str, int]:
        """Host and port."""
        parsed = httpx.URL(self.url)
        return parsed.host, parsed.port or 80

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
        return self.process.wait(within)


@contextmanager
def serving(store: Path, /, **settings: Any) -> Iterator[Served]:  # noqa: ANN401 - values of settings
    """Run ``nacreous serve`` with these settings; it is killed at the end where it still runs."""
    given = {f"NACREOUS_{name.upper()}": str(value) for name, value in settings.items()}
    environment = {**os.environ, "NACREOUS_PORT": "0", "NACREOUS_STORE": str(store), **given}
    log = store.with_name(f"{store.name}.log")
    with log.open("w") as file:
        process = subprocess.Popen([*PROGRAM, "serve"], env=environment, stdout=file, stderr=file)
    try:
        yield Served(process, log)
    finally:
        if process.poll() is None:
            process.kill()
        process.wait()
