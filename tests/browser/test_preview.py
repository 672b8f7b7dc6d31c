"""The preview of the page draws the film of its table, from every side, and says why where it cannot."""

import io
import json
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

import httpx
import numpy as np
import pytest
from numpy.typing import NDArray

from lut_contract import LookupTexture
from served import Served
from visited_page import visited

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator, Page

FloatArray = NDArray[np.float64]

CANVAS = "canvas.preview-canvas"
TITANIUM = "#preset=anodised-titanium"
SHAPES = ("Sphere", "Teapot", "Wing", "Lens")
LIGHTS = ("Studio", "Overcast", "Sunset")
LINEAR_BELOW = 0.78
"""The preview's tone curve leaves a pixel whose channels are all below 0.8 as it is."""


def test_pixels_change_with_the_thickness_as_the_lookup_says(
    ready_page: "Page", service: Served, tmp_path: Path
) -> None:
    """A mirror shows radiance times R(n.v) in every pixel: two films in one light differ as their R do.

    n.v is that of a sphere of radius 1 around the origin, seen from `data-camera`; NumPy reads R from the
    tables that `data-table` names, at the thickness of the spec.
    """
    page = ready_page
    first = _canvas(page).get_attribute("data-table")
    page.goto(f"{page.url.split('#')[0]}{TITANIUM}")
    _await_another_table(page, first)
    _choose(page, "Overcast")
    tables, pictures = [], []
    for thickness_nm in ("60", "90"):
        _set_thickness(page, thickness_nm)
        tables.append(_table(page, service, tmp_path))
        pictures.append(_linear(_picture(page)))
    n_dot_v = _n_dot_v(_canvas(page), pictures[0].shape[:2])
    inside = (n_dot_v > 0.3) & (pictures[0].max(2) < LINEAR_BELOW) & (pictures[1].max(2) < LINEAR_BELOW)
    before, after = (_reflectance(table, n_dot_v[inside]) for table in tables)
    expected = pictures[0][inside] * after / before
    assert inside.mean() > 0.1
    assert np.abs(after - before).mean() > 0.1 * before.mean()
    assert np.abs(pictures[1][inside] - expected).mean() <= 0.02 * expected.mean()


def test_every_shape_in_every_light_is_another_picture(ready_page: "Page") -> None:
    """No two of shape and light look alike, and none is blank."""
    pictures = {}
    for shape in SHAPES:
        _choose(ready_page, shape)
        for light in LIGHTS:
            _choose(ready_page, light)
            pictures[shape, light] = _picture(ready_page)[::4, ::4]
    assert all(picture.std() > 0.03 for picture in pictures.values())
    views = list(pictures.values())
    differences = [np.abs(a - b).mean() for index, a in enumerate(views) for b in views[:index]]
    assert min(differences) > 0.004


def test_keys_turn_the_shape_and_home_turns_it_back(ready_page: "Page") -> None:
    """With the canvas in focus an arrow key changes the picture, and Home brings the first one back."""
    canvas = _canvas(ready_page)
    first = _picture(ready_page)
    canvas.press("ArrowRight")
    _await_stillness(ready_page)
    assert np.abs(_picture(ready_page) - first).mean() > 0.002
    canvas.press("Home")
    _await_stillness(ready_page)
    assert np.abs(_picture(ready_page) - first).mean() < 1e-3


def test_the_picture_is_named_after_the_film_the_shape_and_the_light(ready_page: "Page") -> None:
    """Who cannot see the canvas is told what is on it."""
    ready_page.goto(f"{ready_page.url.split('#')[0]}{TITANIUM}")
    _choose(ready_page, "Teapot")
    ready_page.get_by_role("img", name="Anodised titanium on a teapot, studio light").wait_for()


def test_without_webgl_the_colours_are_shown_flat(browser: "Browser", service: Served) -> None:
    """A browser without 3D gets a disc of the film's colours, a sentence, and a page without errors."""
    flags = ["--disable-gpu", "--disable-software-rasterizer", "--disable-3d-apis"]
    program = shutil.which("chromium")
    with (
        browser.browser_type.launch(executable_path=program, args=flags, chromium_sandbox=False) as flat,
        visited(flat, f"{service.url}/{TITANIUM}") as page,
    ):
        page.wait_for_selector(":root[data-ready]", state="attached")
        page.get_by_text("no WebGL 2").wait_for()
        disc = _pixels(page.get_by_role("img", name="Colours of Anodised titanium over the angle"))
    assert disc.std() > 0.05


def _canvas(page: "Page") -> "Locator":
    return page.locator(CANVAS)


def _choose(page: "Page", choice: str) -> None:
    page.get_by_role("radio", name=choice, exact=True).check(force=True)
    _await_stillness(page)


def _set_thickness(page: "Page", thickness_nm: str) -> None:
    drawn = _canvas(page).get_attribute("data-table")
    page.get_by_role("textbox", name="Thickness of layer 1", exact=True).fill(thickness_nm)
    _await_another_table(page, drawn)
    _await_stillness(page)


def _await_another_table(page: "Page", drawn: str | None) -> None:
    """Wait until a fine table other than the one that was drawn is on the canvas."""
    page.wait_for_selector(f"{CANVAS}:not([data-table='{drawn}'])[data-size='128x65']")


def _await_stillness(page: "Page") -> None:
    """Wait until the last frame that was asked for is drawn, as finely as it will be."""
    page.wait_for_selector(f"{CANVAS}[data-drawn='still']")


def _table(page: "Page", service: Served, folder: Path) -> LookupTexture:
    table = _canvas(page).get_attribute("data-table")
    path = folder / f"{table}.exr"
    path.write_bytes(httpx.get(f"{service.url}/v1/tables/{table}.exr").raise_for_status().content)
    return LookupTexture.read(path)


def _reflectance(table: LookupTexture, n_dot_v: FloatArray) -> FloatArray:
    return table.at(n_dot_v, np.ones_like(n_dot_v))


def _picture(page: "Page") -> FloatArray:
    return _pixels(_canvas(page))


def _pixels(element: "Locator") -> FloatArray:
    """Return what is on the screen, (H, W, 3), from 0 to 1."""
    image = pytest.importorskip("PIL.Image", reason="the Python package pillow is missing")
    return np.asarray(image.open(io.BytesIO(element.screenshot())).convert("RGB"), np.float64) / 255


def _linear(srgb: FloatArray) -> FloatArray:
    """IEC 61966-2-1."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def _n_dot_v(canvas: "Locator", shape: tuple[int, int]) -> FloatArray:
    """Cosine between the normal of the unit sphere and the view in every pixel; 0 beside it."""
    facts = json.loads(canvas.get_attribute("data-camera") or "")
    height, width = shape
    half = np.tan(np.radians(facts["fieldDegrees"]) / 2)
    y, x = np.mgrid[0:height, 0:width] + 0.5
    across, up = half * (2 * x - width) / height, half * (height - 2 * y) / height
    sine2 = (across**2 + up**2) / (1 + across**2 + up**2)  # of the angle between a ray and the axis
    cosine2 = 1 - np.sum(np.square(facts["position"])) * sine2  # the ray passes the middle at distance * sine
    return np.sqrt(np.clip(cosine2, 0, None))
