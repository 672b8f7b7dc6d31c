"""Runs the service until it is told to stop, and ends it in order.

On SIGTERM or SIGINT `/readyz` says 503 at once, while the port stays open so that whoever balances the load
hears it; requests that run are waited for, new ones are refused; then the engine ends, and the process with
exit code 0. A second signal waits no longer.
"""

import asyncio
import gc
import logging
import os
import signal
import socket
from collections.abc import Iterator
from contextlib import contextmanager

from uvicorn import Config, Server

from nacreous.web.app import create_app
from nacreous.web.connections import connection_type
from nacreous.web.engines import GRACE_SECONDS
from nacreous.web.environment import unknown_variables
from nacreous.web.logs import configure
from nacreous.web.service import Service
from nacreous.web.settings import Settings

__all__ = ["GracefulServer", "serve", "server_of"]

_SIGNALS = (signal.SIGTERM, signal.SIGINT)
_KEEP_ALIVE_SECONDS = 30
_BACKLOG = 2048
"""Connections that the system holds until they are accepted."""
_CLOSING_SECONDS = 1.0
"""What connections have left once their requests have been answered."""

_logger = logging.getLogger("nacreous.web")


class GracefulServer(Server):
    """A server that answers probes while it waits for its requests.

    Parameters
    ----------
    config : uvicorn.Config
    service : Service
    """

    def __init__(self, config: Config, service: Service) -> None:
        super().__init__(config)
        self._service = service

    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Stop at a signal; uvicorn's own would raise it once more at the end, and the exit code be no 0."""
        loop = asyncio.get_running_loop()
        for number in _SIGNALS:
            loop.add_signal_handler(number, self._stop)
        try:
            yield
        finally:
            for number in _SIGNALS:
                loop.remove_signal_handler(number)

    def _stop(self) -> None:
        if self._service.stopping.is_set():
            self.force_exit = True
        self._service.stopping.set()
        self.should_exit = True

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Wait for the requests that run, with the port open, and close it then."""
        _logger.info("stopping")
        await self._service.drain()
        await self._service.requests_done(
            self._service.settings.shutdown_seconds - GRACE_SECONDS - _CLOSING_SECONDS
        )
        await super().shutdown(sockets)


def server_of(settings: Settings) -> GracefulServer:
    """Return the server of these settings, which `run` starts."""
    app = create_app(settings)
    config = Config(
        app,
        loop="uvloop",
        http=connection_type(settings.header_seconds, settings.max_header, settings.connections),
        ws="none",
        lifespan="on",
        log_config=None,
        access_log=False,
        server_header=False,
        proxy_headers=False,
        timeout_keep_alive=_KEEP_ALIVE_SECONDS,
        timeout_graceful_shutdown=int(_CLOSING_SECONDS),
    )
    return GracefulServer(config, app.state.service)


def serve(settings: Settings) -> None:
    """Run the service until it is told to stop; raises `OSError` where it cannot listen."""
    configure(settings.log_level)
    for name, remedy in unknown_variables(os.environ):
        _logger.warning("unknown setting", extra={"facts": {"variable": name, "remedy": remedy}})
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    with socket.create_server((settings.host, settings.port), family=family, backlog=_BACKLOG) as listening:
        host, port = listening.getsockname()[:2]
        url = f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"
        _logger.info("listening", extra={"facts": {"url": url}})
        server = server_of(settings)
        gc.freeze()  # what has been imported stays: nobody need look through it again and again
        server.run([listening])
