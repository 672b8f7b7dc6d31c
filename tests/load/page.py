"""Time the page in Chromium and print it beside the targets: `python -m load.page`, tests on the path."""

import statistics
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from built_page import built_page
from served import serving
from web_page import chromium

if TYPE_CHECKING:
    from playwright.sync_api import Browser, ElementHandle, Page

VIEWS, MOVES, RESTS = 10, 60, 40
SCREEN = {"width": 1280, "height": 900}

NOTE_READY = """
new MutationObserver((_, observer) => {
  if (!document.documentElement?.hasAttribute("data-ready")) return;
  window.readyAt = performance.now();
  observer.disconnect();
}).observe(document, { attributes: true, subtree: true });
"""
"""Times the moment from the start of the navigation: no poll from outside is as exact."""

MOVE = """async (slider) => {
  const canvas = document.querySelector(".preview-canvas");
  const least = Number(slider.min), most = Number(slider.max), step = Number(slider.step) || 1;
  const value = Number(slider.value);
  const next = value + 7 * step <= most ? value + 7 * step : least;
  const shown = new Promise((resolve) => {
    new MutationObserver((_, observer) => {
      observer.disconnect();
      requestAnimationFrame(() => resolve(performance.now()));
    }).observe(canvas, { attributeFilter: ["data-table"] });
  });
  const began = performance.now();
  slider.value = String(next);
  slider.dispatchEvent(new Event("input", { bubbles: true }));
  return (await shown) - began;
}"""
"""Moves a slider once; milliseconds until the frame that follows the drawing of another table."""

RESTED = "() => document.querySelector('.preview-canvas').dataset.size === window.fineSize"


def main() -> None:
    """Measure and print."""
    built_page()
    with (
        tempfile.TemporaryDirectory() as name,
        serving(Path(name) / "store") as served,
        chromium() as browser,
    ):
        served.await_ready()
        print_first_view(browser, served.url)
        print_slider(browser, served.url)


def print_first_view(browser: "Browser", url: str) -> None:
    """Time new visitors, none of whom has anything of the page in a cache."""
    milliseconds = sorted(first_view_ms(browser, url) for _ in range(VIEWS))
    print(f"first view on loopback: p50 {statistics.median(milliseconds):.0f} ms,", end=" ")
    print(f"slowest of {VIEWS} {milliseconds[-1]:.0f} ms   (target 1500)", flush=True)


def first_view_ms(browser: "Browser", url: str) -> float:
    """Return the time from the start of the navigation until the fine film is drawn."""
    with browser.new_context(viewport=SCREEN) as context:
        context.add_init_script(NOTE_READY)
        page = context.new_page()
        page.goto(url)
        await_ready(page)
        return float(page.evaluate("window.readyAt"))


def print_slider(browser: "Browser", url: str) -> None:
    """Time the first layer's thickness: in a drag, where a move follows on the last, and from rest."""
    with browser.new_context(viewport=SCREEN) as context:
        page = context.new_page()
        page.goto(url)
        await_ready(page)
        page.evaluate("window.fineSize = document.querySelector('.preview-canvas').dataset.size")
        slider = page.get_by_role("slider", name="Thickness of layer 1").element_handle()
        print_quantiles("slider to pixels, dragged", [move_ms(slider) for _ in range(MOVES)])
        print_quantiles("slider to pixels, from rest", list(rested_moves_ms(page, slider)))


def rested_moves_ms(page: "Page", slider: "ElementHandle") -> Iterator[float]:
    """Yield the times of moves that begin once the fine film is drawn and every plot has its table."""
    for _ in range(RESTS):
        page.wait_for_function(RESTED)
        page.wait_for_load_state("networkidle")
        yield move_ms(slider)


def move_ms(slider: "ElementHandle") -> float:
    """Return the time from an input event to the frame that shows its film."""
    return float(slider.evaluate(MOVE))


def await_ready(page: "Page") -> None:
    """Wait until the first fine film is drawn."""
    page.wait_for_selector(":root[data-ready]", state="attached")


def print_quantiles(name: str, milliseconds: list[float]) -> None:
    """Print the median and the 95th percentile."""
    ordered = sorted(milliseconds)
    p95 = ordered[int(len(ordered) * 0.95)]
    print(f"{name}: p50 {statistics.median(ordered):.0f} ms, p95 {p95:.0f} ms   (target 150)", flush=True)


if __name__ == "__main__":
    main()
