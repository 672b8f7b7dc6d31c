"""The page as a whole: for everybody, light enough, and there again once its service is."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Page

OpenPage = Callable[..., "Page"]

AXE = Path(__file__).parents[1] / "node" / "node_modules" / "axe-core" / "axe.min.js"
DESKTOP, PHONE = {"width": 1280, "height": 900}, {"width": 390, "height": 844}
SCREENS: dict[str, dict[str, Any]] = {
    "light": {"viewport": DESKTOP, "color_scheme": "light"},
    "dark": {"viewport": DESKTOP, "color_scheme": "dark"},
    "phone": {"viewport": PHONE, "color_scheme": "light", "is_mobile": True, "has_touch": True},
    "phone, dark": {"viewport": PHONE, "color_scheme": "dark", "is_mobile": True, "has_touch": True},
}
GRAVE = {"serious", "critical"}
MOST_BYTES = 600_000
SENT_BYTES = """() => ["navigation", "resource"].flatMap((kind) => performance.getEntriesByType(kind))
    .map(({ name, encodedBodySize }) => [new URL(name).pathname, encodedBodySize])
    .filter(([path]) => /\\/$|\\/assets\\/[^/]*$/.test(path))"""
"""The document and the assets of the page, as they came over the wire (Resource Timing, section 4.4)."""


def violations(page: "Page") -> list[str]:
    """Return what axe-core finds that keeps people out, and where."""
    if not AXE.is_file():
        pytest.skip("axe-core is missing: `npm ci --prefix tests/node` installs it")
    page.evaluate(AXE.read_text())
    found = page.evaluate("axe.run({ resultTypes: ['violations'] })")
    return [
        f"{violation['id']}: {node['target']} {node['failureSummary']}"
        for violation in found["violations"]
        if violation["impact"] in GRAVE
        for node in violation["nodes"]
    ]


@pytest.mark.parametrize("screen", SCREENS)
def test_nobody_is_kept_out(open_page: OpenPage, screen: str) -> None:
    """No serious or critical violation of WCAG that axe-core knows, on any screen (issue 6)."""
    page = open_page(**SCREENS[screen])
    page.wait_for_selector(":root[data-ready]", state="attached")
    assert not violations(page)


@pytest.mark.parametrize("screen", SCREENS)
def test_nothing_sticks_out_of_the_screen(open_page: OpenPage, screen: str) -> None:
    """Content reflows: a page is read by scrolling in one direction (WCAG 2.2, 1.4.10)."""
    page = open_page(**SCREENS[screen])
    page.wait_for_selector(":root[data-ready]", state="attached")
    width, screen_width = page.evaluate("[document.documentElement.scrollWidth, innerWidth]")
    assert width <= screen_width


def test_the_first_view_is_light(ready_page: "Page") -> None:
    """What comes before the film is seen is 600 kB at most, compressed (issue 6)."""
    sent = dict(ready_page.evaluate(SENT_BYTES))
    assert {Path(path).suffix for path in sent} >= {"", ".js", ".css"}
    assert all(sent.values())
    assert sum(sent.values()) <= MOST_BYTES, sent
