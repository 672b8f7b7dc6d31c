"""What the documentation shows works: its commands, its Python, its specs, its links and its docstrings."""

import doctest
import importlib
import os
import pkgutil
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

import nacreous
from served import serving

ROOT = Path(__file__).parents[1]
PAGES = sorted(
    page
    for pages in ("*.md", "docs/*.md", "kernels/*.md", "clients/*.md", "clients/*/*.md")
    for page in ROOT.glob(pages)
)
NOT_RUN = "<!-- not run:"
"""Stands, with a reason, in the line above a block that is shown but not run."""

SERVICE = "http://localhost:8000"
"""Where the pages say that a service is; blocks that name it run against one on a port that is free."""

_BLOCK = re.compile(r"(?P<above>[^\n]*)\n```(?P<language>\w+)\n(?P<text>.*?)\n```", re.DOTALL)
_LINK = re.compile(r"\]\((?!https?:)([^)#]+)(?:#[^)]*)?\)")
_FILE = re.compile(r"# (\S+\.toml)\n")


@dataclass(frozen=True)
class Block:
    """A fenced block of a page."""

    language: str
    text: str


def runnable_blocks(page: Path) -> list[Block]:
    """Return the blocks of a page in shell, Python and TOML that are not marked otherwise."""
    found = _BLOCK.finditer(page.read_text(encoding="utf-8"))
    return [
        Block(match["language"], match["text"])
        for match in found
        if match["language"] in RUNNERS and not match["above"].startswith(NOT_RUN)
    ]


def run_shell(text: str, folder: Path) -> None:
    """Run commands as a reader would who has the program on the path."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    _run(["bash", "-euo", "pipefail", "-c", text], folder, path)


def run_python(text: str, folder: Path) -> None:
    """Run a program; a warning is an error."""
    _run([sys.executable, "-W", "error", "-c", text], folder, os.environ["PATH"])


def run_toml(text: str, folder: Path) -> None:
    """Read a spec; one that begins with the name of a file is kept for the commands that follow."""
    nacreous.Spec.from_text(text)
    named = _FILE.match(text)
    if named:
        (folder / named[1]).write_text(text, encoding="utf-8")


def _run(command: list[str], folder: Path, path: str) -> None:
    done = subprocess.run(
        command, cwd=folder, env={**os.environ, "PATH": path}, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, f"{command[-1]}\n{done.stdout}{done.stderr}"


RUNNERS = {"sh": run_shell, "python": run_python, "toml": run_toml}


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Run the service, and return where it is."""
    with serving(tmp_path_factory.mktemp("service")) as served:
        served.await_ready()
        yield served.url


@pytest.mark.parametrize(
    "page", [p for p in PAGES if runnable_blocks(p)], ids=lambda page: str(page.relative_to(ROOT))
)
def test_the_blocks_of_a_page_run_in_order(
    page: Path, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    """A reader may type what a page shows, from its top to its bottom, in one folder."""
    for block in runnable_blocks(page):
        text = block.text
        if "curl" in text and not shutil.which("curl"):
            pytest.skip("the package curl is not installed")
        if SERVICE in text:
            text = text.replace(SERVICE, request.getfixturevalue("service"))
        RUNNERS[block.language](text, tmp_path)


def test_the_calls_of_a_service_leave_what_it_says(service: str, tmp_path: Path) -> None:
    """docs/service.md is not without calls: its textures are those that local commands write."""
    if not shutil.which("curl"):
        pytest.skip("the package curl is not installed")
    for block in runnable_blocks(ROOT / "docs" / "service.md"):
        RUNNERS[block.language](block.text.replace(SERVICE, service), tmp_path)
    run_shell("nacreous tabulate lens.toml -o local && nacreous tabulate soap-bubble -o local", tmp_path)
    for name in ("lens.exr", "soap-bubble.exr"):
        assert (tmp_path / name).read_bytes() == (tmp_path / "local" / name).read_bytes(), name


def test_the_tour_leaves_the_files_it_names(tmp_path: Path) -> None:
    """README.md is not without blocks: its first film is a texture, two pictures, and good."""
    for block in runnable_blocks(ROOT / "README.md")[:1]:
        RUNNERS[block.language](block.text, tmp_path)
    written = {file.name for file in (tmp_path / "tables").iterdir()}
    assert written == {"anodised-titanium.exr", "anodised-titanium.png", "preview.png"}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_to_files(page: Path) -> None:
    """A link or a picture that is no address on the web names a file beside the page."""
    links = _LINK.findall(page.read_text(encoding="utf-8"))
    assert [link for link in links if not (page.parent / link).exists()] == []


@pytest.mark.parametrize(
    "module", [m.name for m in pkgutil.walk_packages(nacreous.__path__, "nacreous.")] + ["nacreous"]
)
def test_examples_in_docstrings(module: str) -> None:
    """An example in a docstring prints what it says."""
    assert doctest.testmod(importlib.import_module(module)).failed == 0


def test_every_verb_is_explained() -> None:
    """`make help` and CONTRIBUTING.md name each target that a person may call."""
    phony = re.search(r"^\.PHONY: (.*)$", (ROOT / "Makefile").read_text(), re.MULTILINE)
    assert phony
    verbs = set(phony[1].split()) - {"help"}
    listed = set(re.findall(r"^\t@echo 'make (\w+)", (ROOT / "Makefile").read_text(), re.MULTILINE))
    contributing = set(re.findall(r"`make (\w+)`", (ROOT / "CONTRIBUTING.md").read_text()))
    assert listed == verbs
    assert verbs <= contributing
