"""A visit to the page of a service: what it complains of, and whom else it asks, is found out."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

if TYPE_CHECKING:
    from playwright.sync_api import Browser, ConsoleMessage, Page, Request

__all__ = ["visited"]

_OF_THE_PAGE_ITSELF = ("blob:", "about:")
"""Addresses that leave nothing: what a page has made, and no page."""
_ASKED_BY_THE_PAGE = ("/v1/", "/healthz")


@dataclass
class _Visit:
    """What a page has done that it must not.

    Parameters
    ----------
    page : playwright.sync_api.Page
    origin : str
        The service's; no other may be asked.
    complaints : list of str
        Errors that it threw, or wrote to the console.
    strangers : list of str
        Addresses elsewhere that it asked for.
    """

    page: "Page"
    origin: str
    complaints: list[str] = field(default_factory=list)
    strangers: list[str] = field(default_factory=list)

    def listen(self) -> None:
        """Write down what happens from now on."""
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("console", self._heard)
        self.page.on("request", self._asked)

    def check(self) -> None:
        """Fail where anything was written down."""
        assert not self.complaints, self.complaints
        assert not self.strangers

    def _heard(self, message: "ConsoleMessage") -> None:
        if message.type == "error" and not self._is_refusal(message):
            self.complaints.append(f"{message.text} ({message.location.get('url', '')})")

    def _is_refusal(self, message: "ConsoleMessage") -> bool:
        """Tell whether Chromium notes a request that was refused or lost: the page shows that."""
        asked = message.location.get("url", "").removeprefix(self.origin)
        return message.text.startswith("Failed to load resource") and asked.startswith(_ASKED_BY_THE_PAGE)

    def _asked(self, request: "Request") -> None:
        if not request.url.startswith((f"{self.origin}/", *_OF_THE_PAGE_ITSELF)):
            self.strangers.append(request.url)


@contextmanager
def visited(browser: "Browser", address: str, **options: Any) -> Iterator["Page"]:  # noqa: ANN401 - of a context
    """Open a page in a context of its own and wait until it has begun to draw; the end fails it, or not."""
    parsed = urlsplit(address)
    with browser.new_context(**options) as context:
        visit = _Visit(context.new_page(), f"{parsed.scheme}://{parsed.netloc}")
        visit.listen()
        visit.page.goto(address, wait_until="load")
        visit.page.wait_for_selector("#page > *", state="attached")
        yield visit.page
        visit.check()
