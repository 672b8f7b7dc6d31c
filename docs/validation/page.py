"""The page docs/validation.md, and tables for it."""

from pathlib import Path

PAGE = Path(__file__).parents[1] / "validation.md"
IMAGES = Path(__file__).parents[1] / "images" / "validation"
OVERVIEW = "overview"
"""The name of the table at the top of the page."""


def block(name: str) -> str:
    """Return what the page says between the marks of a name; raises `ValueError` if it does not have them."""
    text = PAGE.read_text(encoding="utf-8")
    begin, end = (text.find(f"<!-- {name}: {side} -->") for side in ("begin", "end"))
    if not 0 <= begin < end:
        raise ValueError(f"expected <!-- {name}: begin --> and end in {PAGE.name}")
    return text[text.index("\n", begin) : end].strip()


def with_line(overview: str, first_cell: str, line: str) -> str:
    """Return a table in which a line is in the place of the one with its first cell, or at the end."""
    lines = overview.splitlines()
    renewed = [line if each.startswith(f"| {first_cell} |") else each for each in lines]
    return "\n".join(renewed if line in renewed else [*lines, line])


def table(header: str, rows: list[str]) -> str:
    """Return a table in Markdown; a column whose title ends in a colon has numbers."""
    titles = [title.strip() for title in header.split("|")]
    rule = "|".join("--:" if title.endswith(":") else "---" for title in titles)
    shown = " | ".join(title.removesuffix(":") for title in titles)
    return "\n".join([f"| {shown} |", f"|{rule}|", *(f"| {row} |" for row in rows)])


def rounded(value: float) -> str:
    """Return one digit and a power of ten, such as 3e-7."""
    digit, exponent = f"{value:.0e}".split("e")
    return f"{digit}e{int(exponent)}"
