"""The page of the service, built from the sources of this checkout, and the npm that does so."""

import os
import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

__all__ = ["PAGE_SOURCES", "built_page", "npm_command"]

PAGE_SOURCES = Path(__file__).parents[1] / "service" / "page"


def built_page() -> Path:
    """Build the page where it is missing or its sources have changed; skips where there is no npm."""
    return Path(_run("build"))


def npm_command() -> tuple[list[str], dict[str, str]]:
    """Return npm and its environment, the page's packages installed; skips where there is none."""
    command, path = _run("npm_program")
    _run("install_packages")
    return command, {**os.environ, "PATH": path}


def _run(name: str) -> Any:  # noqa: ANN401 - whatever that function returns
    program = runpy.run_path(str(PAGE_SOURCES / "build.py"))
    function: Callable[[], Any] = program[name]
    try:
        return function()
    except program["NoNpmError"] as error:
        pytest.skip(str(error))
