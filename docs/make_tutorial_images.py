"""Make the pictures of the tutorials: `make pictures`, or run this file with PYTHONPATH=tests:docs.

Pictures that a tutorial's own commands write are taken from following it; the page is photographed as
make_page_image.py does it, step by step. Names of tutorials as arguments make the pictures of those alone.
"""

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from PIL import Image

from built_page import built_page
from make_images import write_jpeg
from make_page_image import SECONDS, make_swatches
from served import serving
from tutorial_pages import PAGES, SERVICE, blocks_of, follow
from visited_page import visited
from web_page import chromium

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

IMAGES = Path(__file__).parent / "images" / "tutorials"
WRITTEN = {
    "artist": ("preview.png", "artist-preview.jpg", 1000),
    "researcher": ("sphere.png", "researcher-sphere.jpg", 320),
    "optics": ("oxide.png", "optics-oxide.png", 1050),
}
"""The picture that a tutorial's commands write, what it is called here, and its width."""
VIEWPORT = {"width": 1240, "height": 780}
THICKNESS_NM, MARGIN = "50", 20


def main(chosen: Iterable[str] = ()) -> None:
    """Write the pictures of the tutorials that are named, or of all."""
    IMAGES.mkdir(parents=True, exist_ok=True)
    names = tuple(chosen) or tuple(WRITTEN)
    with TemporaryDirectory() as folder, serving(Path(folder) / "store") as service:
        service.await_ready()
        for page in (page for page in PAGES if page.stem in names and page.stem in WRITTEN):
            take_written(page, Path(folder) / page.stem, service.url)
        if "artist" in names:
            photograph(service.url)


def take_written(page: Path, folder: Path, url: str) -> None:
    """Follow a tutorial in a folder and keep the picture that it makes."""
    folder.mkdir()
    for block in blocks_of(page):
        follow(block, folder, url if SERVICE in block.text else SERVICE)
    source, name, width = WRITTEN[page.stem]
    with Image.open(folder / source) as picture:
        scale = min(1.0, width / picture.width)
        size = (round(scale * picture.width), round(scale * picture.height))
        small = picture.convert("RGB").resize(size, Image.Resampling.LANCZOS)
    write(small, IMAGES / name)


def write(picture: Image.Image, path: Path) -> None:
    """Write lines on white as a PNG of few colours, everything else as a JPEG."""
    if path.suffix == ".png":
        picture.quantize(64).save(path, optimize=True)
    else:
        write_jpeg(picture, path)


def photograph(url: str) -> None:
    """Do on the page what the artist's tutorial says, with a photograph of each step."""
    built_page()
    make_swatches(url)
    with opened(url) as page:
        page.get_by_role("radio", name="Studio").check(force=True)
        keep(page, "artist-preset.jpg")
        set_thickness(page)
        keep(page, "artist-blue.jpg")
        page.get_by_role("button", name="Make the files").click()
        page.get_by_role("radio", name="Blender").check(force=True)
        page.get_by_role("button", name="Download").first.wait_for()
        save(framed(page, page.get_by_role("region", name="Take it away")), "artist-files.jpg")


@contextmanager
def opened(url: str) -> "Iterator[Page]":
    """Open the preset of the tutorial in a browser."""
    address = f"{url}/#preset=anodised-titanium"
    with chromium() as browser, visited(browser, address, viewport=VIEWPORT) as page:
        page.set_default_timeout(SECONDS * 1000)
        yield page


def set_thickness(page: "Page") -> None:
    """Type a thickness, and wait until the film of it is on the shape."""
    drawn = page.locator("canvas[data-drawn]")
    before = drawn.get_attribute("data-table")
    field = page.get_by_label("Thickness of layer 1", exact=True)
    field.fill(THICKNESS_NM)
    field.press("Enter")
    page.locator(f'canvas[data-drawn]:not([data-table="{before}"])').wait_for(state="attached")


def framed(page: "Page", region: "Locator") -> bytes:
    """Return a photograph of a region with some room around it."""
    region.scroll_into_view_if_needed()
    box = region.bounding_box() or {"x": 0, "y": 0, **VIEWPORT}
    x, y = max(box["x"] - MARGIN, 0), max(box["y"] - MARGIN, 0)
    size = {"width": box["width"] + 2 * MARGIN, "height": box["height"] + 2 * MARGIN}
    return page.screenshot(clip={"x": x, "y": y, **size}, full_page=False)


def keep(page: "Page", name: str) -> None:
    """Photograph the whole window once everything has been drawn."""
    page.wait_for_selector(":root[data-ready]", state="attached")
    page.wait_for_selector('canvas[data-drawn="still"]', state="attached")
    page.wait_for_load_state("networkidle")
    save(page.screenshot(), name)


def save(png: bytes, name: str) -> None:
    """Write a photograph."""
    Image.open(BytesIO(png)).convert("RGB").save(IMAGES / name, quality=85, optimize=True)


if __name__ == "__main__":
    main(sys.argv[1:])
