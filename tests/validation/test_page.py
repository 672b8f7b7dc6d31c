"""The page of validation says what its program finds now, and shows its pictures."""

import re
from collections.abc import Callable
from typing import Any

import pytest
from PIL import Image

from validation.comparison import Comparison
from validation.comparisons import comparisons
from validation.page import IMAGES, OVERVIEW, PAGE, block, rounded, table, with_line

NUMBER = re.compile(r"[+-]?\d+(?:\.\d+)?(?:e-?\d+)?")
MOST_BYTES = 150_000
ORDER_OF_MAGNITUDE = 5.0
"""Factor that rounding errors, which are written with an exponent, may change by on another processor."""


@pytest.mark.parametrize("comparison", comparisons(), ids=lambda each: each.name)
def test_the_page_has_the_numbers_of_now(comparison: Comparison[Any], measured: Callable[[str], Any]) -> None:
    """The same words, and every number within one in its last digit."""
    written, found = block(comparison.name), comparison.numbers(measured(comparison.name)).strip()
    assert NUMBER.sub("#", written) == NUMBER.sub("#", found)
    pairs = zip(NUMBER.findall(written), NUMBER.findall(found), strict=True)
    assert [pair for pair in pairs if not agree(*pair)] == []


@pytest.mark.parametrize("comparison", comparisons(), ids=lambda each: each.name)
def test_the_overview_has_them_too(comparison: Comparison[Any], measured: Callable[[str], Any]) -> None:
    """Each comparison has its line, with the numbers of now, and its heading."""
    found = comparison.line(measured(comparison.name))
    written = next(
        line for line in block(OVERVIEW).splitlines() if line.startswith(f"| {comparison.title} |")
    )
    assert NUMBER.sub("#", written) == NUMBER.sub("#", found)
    assert all(agree(*pair) for pair in zip(NUMBER.findall(written), NUMBER.findall(found), strict=True))
    assert f"\n## {comparison.title}\n" in PAGE.read_text(encoding="utf-8")


def test_a_line_of_a_table_is_renewed_or_added() -> None:
    """The first cell says which."""
    overview = "| a | b |\n|---|---|\n| one | 1 |"
    assert with_line(overview, "one", "| one | 2 |") == "| a | b |\n|---|---|\n| one | 2 |"
    assert with_line(overview, "two", "| two | 2 |") == f"{overview}\n| two | 2 |"


def agree(written: str, found: str) -> bool:
    """Say whether two numbers are the same but for their rounding."""
    if "e" in written or "e" in found:
        ratio = float(written) / float(found)
        return 1 / ORDER_OF_MAGNITUDE <= ratio <= ORDER_OF_MAGNITUDE
    digits = len(written.partition(".")[2])
    return abs(float(written) - float(found)) <= 1.001 * 10.0**-digits


def test_a_number_agrees_with_its_neighbours_alone() -> None:
    """One in the last digit, or a factor of five for an error."""
    assert agree("1.2", "1.3")
    assert not agree("1.2", "1.4")
    assert agree("2e-7", "6e-7")
    assert not agree("2e-7", "2e-6")


@pytest.mark.parametrize("comparison", comparisons(), ids=lambda each: each.name)
def test_each_picture_is_there_and_light(comparison: Comparison[Any]) -> None:
    """It is in the page with words for those who do not see it, sharp, and of 150 kB at most."""
    picture = IMAGES / f"{comparison.name}.png"
    assert picture.stat().st_size <= MOST_BYTES
    with Image.open(picture) as opened:
        assert opened.width == 1600
    shown = re.search(rf"!\[(.+)\]\(images/validation/{picture.name}\)", PAGE.read_text(encoding="utf-8"))
    assert shown


def test_a_table_has_its_numbers_on_the_right() -> None:
    """A colon in the header marks a column of numbers; errors have one digit."""
    assert table("name | size, nm:", ["a | 1"]) == "| name | size, nm |\n|---|--:|\n| a | 1 |"
    assert rounded(3.4e-7) == "3e-7"
