"""Make the picture of the page that opens the README: `make pictures`, or this file with PYTHONPATH=tests."""

from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import httpx
from PIL import Image

from built_page import built_page
from served import serving
from visited_page import visited
from web_page import chromium

if TYPE_CHECKING:
    from playwright.sync_api import Page

IMAGE = Path(__file__).parent / "images" / "page.jpg"
PRESET, SHAPE, LIGHT = "morpho", "Wing", "Studio"
WIDTH, HEIGHT = 1440, 900
SWATCHES = 10
"""That such a wide page shows."""
SECONDS = 120


def main() -> None:
    """Open a preset on the page of a service of its own, and photograph it."""
    built_page()
    with TemporaryDirectory() as folder, serving(Path(folder) / "store") as service, chromium() as browser:
        service.await_ready()
        make_swatches(service.url)
        viewport = {"width": WIDTH, "height": HEIGHT}
        with visited(browser, f"{service.url}/#preset={PRESET}", viewport=viewport) as page:
            Image.open(BytesIO(photograph(page))).convert("RGB").save(IMAGE, quality=88, optimize=True)


def make_swatches(url: str) -> None:
    """Have the pictures of all presets made, so that the page need not wait for them."""
    with httpx.Client(base_url=url, timeout=SECONDS) as client:
        for preset in client.get("/v1/presets").json():
            client.get(preset["links"]["png"])


def photograph(page: "Page") -> bytes:
    """Return the page as it looks once everything has been drawn, as a PNG."""
    page.set_default_timeout(SECONDS * 1000)
    page.get_by_role("radio", name=SHAPE).check(force=True)
    page.get_by_role("radio", name=LIGHT).check(force=True)
    page.wait_for_selector(":root[data-ready]", state="attached")
    page.wait_for_selector('canvas[data-drawn="still"]', state="attached")
    page.locator(".gallery img").nth(SWATCHES - 1).wait_for()
    page.wait_for_load_state("networkidle")
    return page.screenshot()


if __name__ == "__main__":
    main()
