"""Which pages of other origins may ask, and a problem for those that may not."""

from collections.abc import Sequence
from http import HTTPStatus

from starlette.datastructures import Headers
from starlette.middleware.cors import CORSMiddleware
from starlette.responses import Response
from starlette.types import ASGIApp

from nacreous.web.problems import Problem

__all__ = ["Cors"]

_EXPOSED = (
    *("ETag", "Location", "Retry-After", "X-Request-Id"),
    *("Content-Disposition", "Content-Range", "Accept-Ranges"),
)


class Cors(CORSMiddleware):
    """Lets pages of some origins ask (Fetch, section 3.3).

    Parameters
    ----------
    app : ASGI application
    origins : sequence of str
        As browsers send them, or ``"*"``.
    """

    def __init__(self, app: ASGIApp, origins: Sequence[str]) -> None:
        super().__init__(
            app,
            allow_origins=origins,
            allow_methods=["GET", "HEAD", "POST", "DELETE"],
            allow_headers=["Authorization", "Content-Type", "If-None-Match", "Range", "If-Range"],
            expose_headers=_EXPOSED,
        )

    def preflight_response(self, request_headers: Headers) -> Response:
        """Answer what a browser asks before a page's request; a refusal is a problem as any other."""
        answer = super().preflight_response(request_headers)
        if answer.status_code < HTTPStatus.BAD_REQUEST:
            return answer
        wrong = bytes(answer.body).decode().removeprefix("Disallowed CORS ")
        detail = f"expected what pages of other origins may ask here, got another {wrong}"
        headers = {name: value for name, value in answer.headers.items() if not name.startswith("content-")}
        return Problem(HTTPStatus(answer.status_code), "cors", detail, headers=headers).response()
