"""kill -9 of a process in the middle of a job: the next one ends it, and the set is the same.

Promise: after resume the set is byte-identical, and at most one table is made again for each kill.
"""

import random
import signal
import subprocess
import sys
from collections import Counter
from pathlib import Path
from threading import Timer

from faults.soak import scale
from nacreous.engine.job import JOBS
from nacreous.store.store import open_store
from small_library import small_sweep

PROGRAM = Path(__file__).parents[1] / "job_process.py"
TABLES = scale(20, 2_000)
KILLS = scale(3, 100)


def _started(folder: Path) -> "subprocess.Popen[str]":
    command = [sys.executable, str(PROGRAM), str(folder), str(TABLES)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, text=True)


def _written(folder: Path) -> list[str]:
    """Let a process come to its end, and return the lines that it has written."""
    with _started(folder) as process:
        return process.communicate()[0].splitlines()


def _written_until_killed(folder: Path, lines: int, seconds: float) -> tuple[list[str], bool]:
    """Kill a process some time after it has written so many lines; return them, and whether it was killed."""
    with _started(folder) as process:
        assert process.stdout is not None
        told = []
        for line in process.stdout:
            told.append(line.strip())
            if len(told) == lines:
                Timer(seconds, process.kill).start()
    return told, process.returncode == -signal.SIGKILL


def _files(folder: Path) -> dict[str, bytes]:
    store = open_store(str(folder))
    entries = {key: store.get(key) for key in store.keys("tables/")}
    assert store.quarantined == 0
    return {key: entry.payload for key, entry in entries.items() if entry is not None}


def test_a_killed_job_is_ended_by_the_next_process(tmp_path: Path) -> None:
    """Killed at random points again and again: the same files, one table redone a kill, nothing left over."""
    chance = random.Random(7)  # noqa: S311 - when to kill
    told: list[str] = []
    kills = 0
    for _ in range(KILLS):
        lines, seconds = chance.randint(1, TABLES // KILLS), chance.uniform(0, 0.1)
        written, killed = _written_until_killed(tmp_path / "killed", lines, seconds)
        told, kills = told + written, kills + killed
    assert kills > KILLS // 2
    *rest, end = _written(tmp_path / "killed")
    assert end == f"done {TABLES} 0"
    assert _written(tmp_path / "whole")[-1] == end

    assert _files(tmp_path / "killed") == _files(tmp_path / "whole")
    made = Counter(line for line in told + rest if not line.startswith("done"))
    assert set(made) == {small_sweep(TABLES)[index][0].id for index in range(TABLES)}
    assert sum(made.values()) - len(made) <= kills
    assert len(list(open_store(str(tmp_path / "killed")).keys(JOBS))) == 1
