"""The program itself, in a process of its own."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

PROGRAM = (sys.executable, "-c", "from nacreous.cli.app import main; main()")
"""What the installed script `nacreous` does, with the Python that runs the tests."""

Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Return what runs the program in an empty folder, its output in pipes."""

    def run_program(*arguments: str, **options: object) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [*PROGRAM, *arguments], cwd=tmp_path, capture_output=True, text=True, check=False, **options
        )

    return run_program


@pytest.fixture
def program() -> tuple[str, ...]:
    """Return the command that is the program."""
    return PROGRAM
