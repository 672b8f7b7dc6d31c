"""What the documentation shows works: its commands, its Python, its specs, its links and its docstrings."""

import doctest
import importlib.util
import os
import pkgutil
import re
import shutil
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import pytest

import nacreous
from served import serving

ROOT = Path(__file__).parents[1]
PAGES = sorted(
    page
    for pages in ("*.md", "docs/**/*.md", "kernels/*.md", "clients/*.md", "clients/*/*.md")
    for page in ROOT.glob(pages)
)
TUTORIALS = ROOT / "docs" / "tutorials"
"""Followed by test_tutorials.py, which compares what they print as well."""
NOT_RUN = "<!-- not run:"
"""Stands, with a reason, in the line above a block that is shown but not run."""
NEEDS = re.compile(r"<!-- needs: (?P<names>[\w, .-]+) -->")
"""Stands above a block that runs where these programs or Python modules are."""
SHOWN = frozenset({"text"})
"""Languages of what a program prints, or a person reads."""

SERVICE = "http://localhost:8000"
"""Where the pages say that a service is; blocks that name it run against one on a port that is free."""

_BLOCK = re.compile(
    r"^(?P<indent> *)(?P<fence>`{3,})(?P<language>[^`\n]*)\n(?P<text>.*?)\n?^(?P=indent)(?P=fence) *$",
    re.MULTILINE | re.DOTALL,
)
_LINK = re.compile(r"\]\((?!https?:)([^)#]+)(?:#[^)]*)?\)")
_FILE = re.compile(r"# (\S+\.toml)\n")


@dataclass(frozen=True)
class Block:
    """A fenced block of a page, and the line above it."""

    language: str
    text: str
    above: str

    @property
    def missing(self) -> list[str]:
        """What of that the block needs is not there."""
        needs = NEEDS.fullmatch(self.above)
        names = needs["names"].split(", ") if needs else []
        return [name for name in names if not (shutil.which(name) or importlib.util.find_spec(name))]


def blocks(page: Path) -> list[Block]:
    """Return the blocks of a page, those of directives aside."""
    text = page.read_text(encoding="utf-8")
    return [
        Block(match["language"].strip(), textwrap.dedent(match["text"]), _line_above(text, match.start()))
        for match in _BLOCK.finditer(text)
        if not match["language"].startswith("{")
    ]


def _line_above(text: str, start: int) -> str:
    return text[:start].removesuffix("\n").rpartition("\n")[2].strip()


def runnable_blocks(page: Path) -> list[Block]:
    """Return the blocks of a page that a program can read and that are not marked otherwise."""
    return [
        block for block in blocks(page) if block.language in RUNNERS and not block.above.startswith(NOT_RUN)
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


def run_xml(text: str, _: Path) -> None:
    """Read a piece of a document."""
    ElementTree.fromstring(text)  # noqa: S314 - it is ours


def _run(command: list[str], folder: Path, path: str) -> None:
    done = subprocess.run(
        command, cwd=folder, env={**os.environ, "PATH": path}, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, f"{command[-1]}\n{done.stdout}{done.stderr}"


RUNNERS = {"sh": run_shell, "python": run_python, "toml": run_toml, "xml": run_xml}


_NO_PART_OF_A_COPY = shutil.ignore_patterns("node_modules", "__pycache__", "dist")


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Run the service, and return where it is."""
    with serving(tmp_path_factory.mktemp("service")) as served:
        served.await_ready()
        yield served.url


@pytest.mark.parametrize(
    "page",
    [p for p in PAGES if runnable_blocks(p) and p.parent != TUTORIALS],
    ids=lambda page: str(page.relative_to(ROOT)),
)
def test_the_blocks_of_a_page_run_in_order(
    page: Path, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    """A reader may type what a page shows, from its top to its bottom, in one folder with the client."""
    if page.is_relative_to(ROOT / "clients"):
        shutil.copytree(page.parent, tmp_path, ignore=_NO_PART_OF_A_COPY, dirs_exist_ok=True)
    for block in runnable_blocks(page):
        text = block.text
        if block.missing:
            pytest.skip(f"not installed: {', '.join(block.missing)}")
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
def test_every_block_is_run_or_says_why_not(page: Path) -> None:
    """A block is run, or is output, or has a reason; a test that the reason names is there."""
    for block in blocks(page):
        marked = block.above.startswith(NOT_RUN)
        assert block.language in RUNNERS or block.language in SHOWN or marked, block
        named = re.findall(r"\btests/[\w/.]+\.py\b", block.above) if marked else []
        assert [name for name in named if not (ROOT / name).exists()] == []


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
