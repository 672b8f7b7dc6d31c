"""The pages of docs/tutorials, followed as a newcomer would: block after block, in one folder."""

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

__all__ = ["PAGES", "Block", "blocks_of", "follow"]

ROOT = Path(__file__).parents[1]
PAGES = tuple(sorted((ROOT / "docs" / "tutorials").glob("*.md")))
SERVICE = "http://localhost:8000"
"""Where the pages say that a service is; another one stands in for it."""

RUN, SPEC, OUTPUT = ("sh", "python"), "toml", "text"
_BLOCK = re.compile(r"(?P<above>[^\n]*)\n```(?P<language>\w+)\n(?P<text>.*?)\n```", re.DOTALL)
_FILE = re.compile(r"# (\S+)\n")
_NOT_RUN = "<!-- not run:"


@dataclass(frozen=True)
class Block:
    """A command, program or spec of a page, and the output that the page shows below it, if any."""

    language: str
    text: str
    shown: str | None


def blocks_of(page: Path) -> Iterator[Block]:
    """Yield what a reader is to run or to write down, in order."""
    found = list(_BLOCK.finditer(page.read_text(encoding="utf-8")))
    for block, after in zip(found, [*found[1:], None], strict=True):
        if block["language"] in (*RUN, SPEC) and not block["above"].startswith(_NOT_RUN):
            shown = after["text"] if after and after["language"] == OUTPUT else None
            yield Block(block["language"], block["text"], shown)


def follow(block: Block, folder: Path, service: str) -> str:
    """Run a block, or write its file down, and return what is printed; a program that fails is an error."""
    text = block.text.replace(SERVICE, service)
    if block.language == SPEC:
        name = _FILE.match(text)
        assert name, f"a spec of a tutorial begins with the name of its file: {text}"
        (folder / name[1]).write_text(text, encoding="utf-8")
        return ""
    if block.language == "python":
        return _printed([sys.executable, "-W", "error", "-c", text], folder).replace(service, SERVICE)
    return _printed(["bash", "-euo", "pipefail", "-c", text], folder).replace(service, SERVICE)


def _printed(command: list[str], folder: Path) -> str:
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "PATH": path, "COLUMNS": "100"}
    done = subprocess.run(
        command,
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    assert done.returncode == 0, f"{command[-1]}\n{done.stdout}"
    return done.stdout
