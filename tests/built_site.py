"""The documentation's site, built as `make docs` builds it, and its pages as a browser reads them."""

import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag

__all__ = ["Entry", "Page", "Site", "build_site"]

ROOT = Path(__file__).parents[1]
_VOID = frozenset({"area", "base", "br", "col", "embed", "hr", "img", "input", "link", "meta", "source"})
_LOADED = {"img": "src", "script": "src", "iframe": "src", "source": "src", "video": "src", "audio": "src"}
_CSS_ADDRESS = re.compile(r"""url\(\s*["']?([^"')]+)|@import\s+["']([^"']+)""")


@dataclass
class Entry:
    """An entry of the reference: the name it has, and all of its text."""

    section: str
    name: str = ""
    text: str = ""


@dataclass
class Page(HTMLParser):
    """A page of HTML: its ids, links, what it loads, its text, and the entries of a reference."""

    path: Path
    ids: set[str] = field(default_factory=set)
    links: list[str] = field(default_factory=list)
    loaded: list[str] = field(default_factory=list)
    text: str = ""
    entries: list[Entry] = field(default_factory=list)
    _open: list[tuple[str, str]] = field(default_factory=list)
    _sections: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Read the file."""
        super().__init__()
        self.feed(self.path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note what an element is, points at and loads."""
        named = {name: value or "" for name, value in attrs}
        self.ids |= {named["id"]} if "id" in named else set()
        self.links += [named["href"]] if tag == "a" and "href" in named else []
        loads = _LOADED.get(tag, "href" if tag == "link" else "")
        self.loaded += [named[loads]] if loads in named and named.get("rel") not in _NOT_LOADED else []
        if tag not in _VOID:
            self._open.append((tag, named.get("class", "")))
            self._begin(tag, named)

    def _begin(self, tag: str, named: dict[str, str]) -> None:
        if tag == "section":
            self._sections.append(named.get("id", ""))
        if "nacreous-entry" in named.get("class", "").split():
            self.entries.append(Entry(self._sections[-1]))

    def handle_endtag(self, tag: str) -> None:
        """Close the element, and those that HTML lets end with it."""
        while self._open and self._open.pop()[0] != tag:
            pass
        if tag == "section":
            self._sections.pop()

    def handle_data(self, data: str) -> None:
        """Note the text, and to which entry it belongs."""
        self.text += data
        classes = " ".join(classes for _, classes in self._open).split()
        if "nacreous-entry" in classes:
            self.entries[-1].text += data
            self.entries[-1].name += data if "descname" in classes else ""


_NOT_LOADED = ("canonical", "index", "search", "next", "prev", "author", "copyright")


@dataclass(frozen=True)
class Site:
    """The built site."""

    folder: Path
    warnings: str

    @cached_property
    def pages(self) -> dict[str, Page]:
        """Every page by its path below the site; folders with an underscore hold files, not pages."""
        files = [file for file in sorted(self.folder.rglob("*.html")) if not self._is_a_file(file)]
        return {file.relative_to(self.folder).as_posix(): Page(file) for file in files}

    def _is_a_file(self, path: Path) -> bool:
        return path.relative_to(self.folder).parts[0].startswith("_")

    def entries(self, page: str) -> dict[str, Entry]:
        """Return the entries of a page by name, where each name is there once."""
        return {entry.name: entry for entry in self.pages[page].entries}

    def dead_links(self) -> Iterator[str]:
        """Yield each link that leads to no file, or to no id of one, with the page that has it."""
        for name, page in self.pages.items():
            for link in [*page.links, *page.loaded]:
                if not _leaves(link) and not self._leads_somewhere(page, link):
                    yield f"{name}: {link}"

    def _leads_somewhere(self, page: Page, link: str) -> bool:
        address, anchor = urldefrag(link)
        path = unquote(address.partition("?")[0])
        target = (page.path.parent / path).resolve() if path else page.path
        if not target.is_file():
            return False
        found = self.pages.get(target.relative_to(self.folder).as_posix())
        return not anchor or found is None or unquote(anchor) in found.ids

    def foreign_requests(self) -> Iterator[str]:
        """Yield each address of another origin that a page or a style sheet has loaded."""
        for name, page in self.pages.items():
            yield from (f"{name}: {address}" for address in page.loaded if _leaves(address))
        for sheet in self.folder.rglob("*.css"):
            for match in _CSS_ADDRESS.finditer(sheet.read_text(encoding="utf-8")):
                address = match[1] or match[2]
                if _leaves(address) and not address.startswith("data:"):
                    yield f"{sheet.name}: {address}"


def _leaves(address: str) -> bool:
    return bool(re.match(r"(?:[a-z][a-z0-9+.-]*:|//)", address))


def build_site(folder: Path) -> Site:
    """Build the site as `make docs` does, and return it with what the build warned of."""
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-n", "-q", "-E"]
    done = subprocess.run(
        [*command, "-d", folder / "doctrees", ROOT / "docs", folder / "site"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode in (0, 1), done.stderr
    return Site(folder / "site", done.stderr)
