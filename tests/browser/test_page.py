"""The page as a whole: for everybody, light enough, and there again once its service is."""

import signal
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from built_page import built_page
from served import Served, serving
from visited_page import visited

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

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
PREVIEW = ".preview-canvas[data-table]"
KEY = "a-key-for-the-dialogue"
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


@pytest.mark.parametrize("screen", ["light", "dark", "phone"])
def test_nobody_is_kept_out_by_what_opens(open_page: OpenPage, screen: str) -> None:
    """The same with the list of materials open, and with all that is folded unfolded."""
    page = open_page(**SCREENS[screen])
    page.wait_for_selector(":root[data-ready]", state="attached")
    page.get_by_role("combobox", name="Incident medium").fill("silver")
    page.get_by_role("listbox", name="Materials").get_by_role("option").first.wait_for()
    assert not violations(page)
    page.keyboard.press("Escape")
    page.evaluate("for (const folded of document.querySelectorAll('details')) folded.open = true")
    assert not violations(page)


@pytest.fixture(scope="module")
def guarded(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    """Run a service that wants a key."""
    built_page()
    with serving(tmp_path_factory.mktemp("guarded") / "store", api_keys=KEY) as served:
        served.await_ready()
        yield served


@pytest.mark.parametrize("screen", ["light", "dark", "phone"])
def test_nobody_is_kept_out_by_the_dialogue(browser: "Browser", guarded: Served, screen: str) -> None:
    """Where the service wants a key, a dialogue asks for it; the film is there once it has been given."""
    with visited(browser, guarded.url, **SCREENS[screen]) as page:
        dialogue = page.get_by_role("dialog")
        dialogue.wait_for()
        assert not violations(page)
        dialogue.get_by_label("Key").fill(KEY)
        dialogue.get_by_role("button").click()
        page.wait_for_selector(PREVIEW)


@pytest.mark.parametrize("screen", SCREENS)
def test_nothing_sticks_out_of_the_screen(open_page: OpenPage, screen: str) -> None:
    """Content reflows: a page is read by scrolling in one direction (WCAG 2.2, 1.4.10)."""
    page = open_page(**SCREENS[screen])
    page.wait_for_selector(":root[data-ready]", state="attached")
    assert page.evaluate("document.documentElement.scrollWidth") <= SCREENS[screen]["viewport"]["width"]


def test_the_first_view_is_light(ready_page: "Page") -> None:
    """What comes before the film is seen is 600 kB at most, compressed (issue 6)."""
    sent = dict(ready_page.evaluate(SENT_BYTES))
    assert {Path(path).suffix for path in sent} >= {"", ".js", ".css"}
    assert all(sent.values())
    assert sum(sent.values()) <= MOST_BYTES, sent


def test_an_edit_outlives_the_service(browser: "Browser", tmp_path: Path) -> None:
    """A service that is killed is said to be away; once it is back, what was changed meanwhile is shown."""
    from playwright.sync_api import expect

    built_page()
    with serving(tmp_path / "store") as served:
        served.await_ready()
        host, port = served.address
        with visited(browser, f"http://{host}:{port}/", viewport=DESKTOP) as page:
            page.wait_for_selector(":root[data-ready]", state="attached")
            served.stop(signal.SIGKILL)
            thickness = page.get_by_role("textbox", name="Thickness of layer 1")
            drawn = drawn_table(page)
            thickness.fill("431")
            lost = page.get_by_role("status").filter(has_text="does not answer")
            expect(lost).to_be_visible(timeout=30_000)
            expect(thickness).to_have_value("431")
            assert drawn_table(page) == drawn
            with serving(tmp_path / "store", port=port) as again:
                again.await_ready()
                expect(lost).to_be_hidden(timeout=30_000)
                expect(page.locator(f"{PREVIEW}:not([data-table='{drawn}'])")).to_be_visible(timeout=30_000)
                expect(thickness).to_have_value("431")


def drawn_table(page: "Page") -> str:
    """Return the id of the table that the preview shows."""
    return str(page.locator(PREVIEW).get_attribute("data-table"))


def test_a_film_that_takes_long_is_drawn_coarser(open_page: OpenPage) -> None:
    """Ridges of uneven width are a thousand films each: as many texels are asked for as are made at once."""
    page = open_page("#preset=morpho-ridges")
    page.wait_for_selector(":root[data-ready]", state="attached", timeout=60_000)
    canvas = page.wait_for_selector("canvas.preview-canvas[data-table]")
    assert canvas.get_attribute("data-size") in ("32x9", "64x17")
    assert page.get_by_text("takes at most").count() == 0
