"""The page of a running service in Debian's Chromium.

`page` is open and has begun to draw. A test that looks at colours takes `ready_page`, in which the first fine
lookup texture has been drawn or refused as well. `open_page` opens further ones: another viewport, or colours
for the dark. A page that complains, or asks anyone but the service, fails its test.
"""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import TYPE_CHECKING

import pytest

from built_page import built_page
from served import Served, serving
from visited_page import visited
from web_page import chromium

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

DESKTOP = (1280, 900)
PATIENCE_MS = 30_000
"""Before an expectation is given up: the worker may have a swatch in hand, and the machine other tests."""


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    """Run the service with an empty store, and with the page as its sources are now.

    For the tests of one file: tests of faults look at all processes that theirs has started.
    """
    built_page()
    with serving(tmp_path_factory.mktemp("service") / "store") as served:
        served.await_ready()
        yield served


@pytest.fixture(scope="module")
def browser() -> Iterator["Browser"]:
    """Run Chromium, for the tests of one file: while Playwright runs, no other event loop can."""
    from playwright.sync_api import expect

    expect.set_options(timeout=PATIENCE_MS)
    with chromium() as browser:
        yield browser


@pytest.fixture
def open_page(browser: "Browser", service: Served) -> Iterator[Callable[..., "Page"]]:
    """Return what opens a page of the service, by its relative address, with options of a browser context."""
    with ExitStack() as pages:

        def opened(address: str = "", /, **options: object) -> "Page":
            return pages.enter_context(visited(browser, f"{service.url}/{address}", **options))

        yield opened


@pytest.fixture
def page(open_page: Callable[..., "Page"]) -> "Page":
    """Open the page on a desktop's screen."""
    return open_page(viewport={"width": DESKTOP[0], "height": DESKTOP[1]})


@pytest.fixture
def ready_page(page: "Page") -> "Page":
    """Open the page and wait until its first fine lookup texture has been drawn, or refused."""
    page.wait_for_selector(":root[data-ready]", state="attached")
    return page
