"""What the service is compared with: the same bytes from starlette alone, in the same server.

`python -m load.plain_app FILE` listens on a free port of 127.0.0.1 and prints where.
"""

import socket
import sys
from pathlib import Path

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import FileResponse, Response
from starlette.routing import Route
from uvicorn import Config, Server

from nacreous.web.connections import connection_type

MEDIA_TYPE = "image/x-exr"


def plain_app(path: Path) -> Starlette:
    """Return an app that answers a file from memory, and from the disk."""
    content = path.read_bytes()

    async def response(_: Request) -> Response:
        return Response(content, media_type=MEDIA_TYPE)

    async def file(_: Request) -> Response:
        return FileResponse(path, media_type=MEDIA_TYPE)

    return Starlette(routes=[Route("/response", response), Route("/file", file)])


def main() -> None:
    """Serve until the process is ended."""
    with socket.create_server(("127.0.0.1", 0), backlog=2048) as listening:
        print(f"http://127.0.0.1:{listening.getsockname()[1]}", flush=True)
        config = Config(
            plain_app(Path(sys.argv[1])),
            loop="uvloop",
            http=connection_type(10, 32 * 2**10, 1000),
            ws="none",
            log_config=None,
            access_log=False,
            server_header=False,
            proxy_headers=False,
        )
        Server(config).run([listening])


if __name__ == "__main__":
    main()
