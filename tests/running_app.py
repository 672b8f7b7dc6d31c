"""An app of the service that runs in this process, for tests of its routes: no sockets, the real parts."""

import asyncio
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import httpx
from fastapi import FastAPI

from nacreous.engine.engine import Readiness
from nacreous.engine.in_process import InProcessEngine
from nacreous.web.app import create_app
from nacreous.web.settings import Settings

__all__ = ["RunningApp", "running_app", "settings_for"]

SECONDS = 60.0


@dataclass(frozen=True)
class RunningApp:
    """An app, the event loop that it runs in, and a client of it."""

    app: FastAPI
    loop: asyncio.AbstractEventLoop
    client: httpx.AsyncClient

    def request(self, method: str, url: str, **options: Any) -> httpx.Response:  # noqa: ANN401 - httpx's options
        """Send a request and return the whole answer."""
        return self.run(self.client.request(method, url, **options))

    def get(self, url: str, **options: Any) -> httpx.Response:  # noqa: ANN401 - httpx's options
        """Send a GET."""
        return self.request("GET", url, **options)

    def post(self, url: str, **options: Any) -> httpx.Response:  # noqa: ANN401 - httpx's options
        """Send a POST."""
        return self.request("POST", url, **options)

    def run(self, coroutine: Any) -> Any:  # noqa: ANN401 - any coroutine and its result
        """Run a coroutine in the app's event loop."""
        return asyncio.run_coroutine_threadsafe(coroutine, self.loop).result(SECONDS)

    @property
    def computed(self) -> int:
        """Works that the engine has done."""
        return int(self.app.state.service.engine.computed)


def settings_for(folder: Path, **changes: Any) -> Settings:  # noqa: ANN401 - values of settings
    """Return settings with a store in `folder`."""
    return Settings(**{"store": str(folder / "store"), "store_quota": 2**28, **changes})


@contextmanager
def running_app(settings: Settings) -> Iterator[RunningApp]:
    """Run an app around an engine in this process."""
    loop = asyncio.new_event_loop()
    thread = threading.Thread(target=loop.run_forever)
    thread.start()
    try:
        app = create_app(settings, InProcessEngine())
        transport = httpx.ASGITransport(app, raise_app_exceptions=False)
        client = httpx.AsyncClient(transport=transport, base_url="http://nacreous.test")
        running = RunningApp(app, loop, client)
        lifespan = app.router.lifespan_context(app)
        running.run(lifespan.__aenter__())
        try:
            running.run(_ready(app))
            yield running
        finally:
            running.run(client.aclose())
            running.run(lifespan.__aexit__(None, None, None))
    finally:
        loop.call_soon_threadsafe(loop.stop)
        thread.join()
        loop.close()


async def _ready(app: FastAPI) -> None:
    """Wait until the engine takes work."""
    async with asyncio.timeout(SECONDS):
        while app.state.service.engine.state.readiness is Readiness.STARTING:
            await asyncio.sleep(0.01)
