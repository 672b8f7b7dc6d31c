"""Pages in a real browser: a local server, Debian's Chromium, and what a page asked for and said."""

import shutil
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

_QUIET = (
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)
_SOFTWARE_WEBGL = ("--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")


@dataclass
class WebPage:
    """A page that has been opened.

    Parameters
    ----------
    page : playwright.sync_api.Page
    origin : str
        The server's, without a slash at the end.
    requests : list of str
        Every address that was asked for.
    complaints : list of str
        What the page wrote to the console as a warning or an error, and what it threw.
    """

    page: "Page"
    origin: str
    requests: list[str] = field(default_factory=list)
    complaints: list[str] = field(default_factory=list)

    def call(self, function: str, argument: object = None) -> Any:  # noqa: ANN401 - any JSON
        """Call a function of ``window`` and wait for what it, or its promise, returns."""
        return self.page.evaluate(f"argument => window.{function}(argument)", argument)


@contextmanager
def chromium() -> Iterator["Browser"]:
    """Start Debian's Chromium with WebGL in software; skips if there is none to be had."""
    playwright = pytest.importorskip("playwright.sync_api", reason="the Python package playwright is missing")
    program = shutil.which("chromium")
    if program is None:
        pytest.skip("a browser is missing: install the package chromium")
    arguments = [*_QUIET, *_SOFTWARE_WEBGL]
    with playwright.sync_playwright() as run:
        browser = run.chromium.launch(executable_path=program, args=arguments, chromium_sandbox=False)
        yield browser
        browser.close()


@contextmanager
def open_page(browser: "Browser", folder: Path, address: str, width: int = 800) -> Iterator[WebPage]:
    """Serve a folder and open a page of it, half as high as wide."""
    with _serve(folder) as origin:
        page = browser.new_page(viewport={"width": width, "height": width // 2})
        opened = WebPage(page, origin)
        page.on("request", lambda request: opened.requests.append(request.url))
        page.on("console", lambda message: _note(opened, message.type, message.text))
        page.on("pageerror", lambda error: opened.complaints.append(str(error)))
        page.goto(f"{origin}/{address}", wait_until="load")
        yield opened
        page.close()


def _note(opened: WebPage, kind: str, text: str) -> None:
    if kind in {"warning", "error"}:
        opened.complaints.append(text)


class _Quiet(SimpleHTTPRequestHandler):
    """A server that keeps its log to itself."""

    def log_message(self, *_: object) -> None:
        """Write nothing."""


@contextmanager
def _serve(folder: Path) -> Iterator[str]:
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(_Quiet, directory=str(folder))) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            yield f"http://127.0.0.1:{server.server_port}"
        finally:
            server.shutdown()
