"""Places in a Markdown page that a program writes.

<!-- figure-3: begin -->
what `make figures` wrote
<!-- figure-3: end -->
"""

from collections.abc import Iterable
from pathlib import Path


def write_block(page: Path, name: str, lines: Iterable[str]) -> None:
    """Put lines between the marks of a name; raises `ValueError` if the page does not have them."""
    text = page.read_text(encoding="utf-8")
    begin, end = (f"<!-- {name}: {side} -->\n" for side in ("begin", "end"))
    before, found, rest = text.partition(begin)
    _, closed, after = rest.partition(end)
    if not (found and closed):
        raise ValueError(f"expected the marks {begin.strip()} and {end.strip()} in {page.name}")
    page.write_text(before + begin + "\n".join(["", *lines, "", ""]) + end + after, encoding="utf-8")
