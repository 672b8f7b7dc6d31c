r"""Links as a code host has them, turned into links of the site.

A page is written with links from its own folder: ``[Mitsuba](../clients/mitsuba/README.md)``. On the site a
file that some page includes is that page; any other file of the repository, such as a scene or a shader, is
offered as a download. Links are rewritten in the text before it is parsed, since afterwards nobody knows in
which folder a text that is included was written.
"""

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from sphinx.application import Sphinx

__all__ = ["included_files", "site_links", "use_repository_links"]

DOCS = Path(__file__).parents[1]
ROOT = DOCS.parent

_FENCED = r"^(?P<fence>```+|~~~+)(?!\{).*?^(?P=fence)[ ]*$"
_INLINE = r"(?<!`)(?P<ticks>`+)(?!`)(?:(?!\n\n).)+?(?<!`)(?P=ticks)(?!`)"
_CODE = re.compile(f"{_FENCED}|{_INLINE}", re.MULTILINE | re.DOTALL)
_LINK = re.compile(r"(?P<before>\]\()(?P<path>[^)\s#:]+)(?P<anchor>#[^)\s]*)?(?=[)\s])")
_INCLUDE = re.compile(r"^```\{include\} (\S+)$", re.MULTILINE)


def use_repository_links(app: Sphinx) -> None:
    """Rewrite the links of pages and of what they include."""
    app.connect("source-read", _read_page)
    app.connect("include-read", _read_included)


def _read_page(app: Sphinx, docname: str, content: list[str]) -> None:
    content[0] = site_links(content[0], Path(app.env.doc2path(docname)))


def _read_included(_: Sphinx, path: Path, __: str, content: list[str]) -> None:
    content[0] = site_links(content[0], (DOCS / path).resolve())


def site_links(text: str, source: Path) -> str:
    """Return the text of a Markdown file with its links to files as the site has them."""
    return "".join(
        part if is_code else _LINK.sub(lambda link: _rewritten(link, source), part)
        for part, is_code in _parts(text)
    )


def _parts(text: str) -> Iterator[tuple[str, bool]]:
    """Yield the text in pieces, each with whether it is code."""
    end = 0
    for found in _CODE.finditer(text):
        yield text[end : found.start()], False
        yield found[0], True
        end = found.end()
    yield text[end:], False


def _rewritten(link: re.Match[str], source: Path) -> str:
    target = (source.parent / link["path"]).resolve()
    if not target.is_file():
        return link[0]
    page = included_files().get(target)
    path = page or Path("/", *_from_docs(target).parts)
    return f"{link['before']}{path.as_posix()}{link['anchor'] or ''}"


def _from_docs(target: Path) -> Path:
    return target.relative_to(DOCS) if target.is_relative_to(DOCS) else Path("..", target.relative_to(ROOT))


@cache
def included_files() -> dict[Path, Path]:
    """Return the page, as an absolute path of the site, of each file that a page includes."""
    pages = [page for page in sorted(DOCS.rglob("*.md")) if page.is_file()]
    return {
        (page.parent / included).resolve(): Path("/", page.relative_to(DOCS))
        for page in pages
        for included in _INCLUDE.findall(page.read_text(encoding="utf-8"))
    }
