"""Bearer keys: where any is set, nobody gets further without one of them."""

import hmac
from collections.abc import Sequence
from http import HTTPStatus

from starlette.types import ASGIApp, Receive, Scope, Send

from nacreous.web.problems import ProblemError

__all__ = ["OPEN_PATHS", "Keys"]

OPEN_PATHS = frozenset({"/", "/healthz", "/readyz"})
"""Paths that need no key: what a load balancer asks, and a page that says nothing of what is stored."""

_OPENED_BY_A_BROWSER = ("/docs", "/openapi.json", "/assets/")
"""What a browser loads, which has no key yet; it says nothing of what is stored."""

_CHALLENGE = 'Bearer realm="nacreous"'


class Keys:
    """Requires ``Authorization: Bearer <key>``, compared in constant time; a key elsewhere is none."""

    def __init__(self, app: ASGIApp, keys: Sequence[bytes]) -> None:
        self._app, self._keys = app, tuple(keys)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass the request on, or raise `ProblemError` 401."""
        path = scope["path"]
        if path not in OPEN_PATHS and not path.startswith(_OPENED_BY_A_BROWSER) and not self._known(scope):
            headers = {"WWW-Authenticate": _CHALLENGE}
            detail = "expected the header Authorization: Bearer with a key of this service"
            raise ProblemError(HTTPStatus.UNAUTHORIZED, "key", detail, headers=headers)
        await self._app(scope, receive, send)

    def _known(self, scope: Scope) -> bool:
        given = [value for name, value in scope["headers"] if name == b"authorization"]
        if len(given) != 1:
            return False
        scheme, _, key = given[0].partition(b" ")
        # Every key is compared, so that the time says nothing of which one was nearly right.
        matches = [hmac.compare_digest(key.strip(), known) for known in self._keys]
        return scheme.lower() == b"bearer" and any(matches)
