"""The short way to a file that is in memory: no router, no request object, no copy.

The route of the same path, in `nacreous.web.routes.tables`, answers everything else and is what OpenAPI has.
"""

import re

from starlette.types import ASGIApp, Receive, Scope, Send

from nacreous.engine.files import format_of_suffix
from nacreous.engine.library import Library
from nacreous.web.caching import FileResponse
from nacreous.web.files import COMPRESSED, representation
from nacreous.web.observation import TEMPLATE

__all__ = ["TABLE_FILE", "HotFiles"]

TABLE_FILE = "/v1/tables/{table_id}.{suffix}"
_PATH = re.compile(r"/v1/tables/([0-9a-f]{64})(\.[a-z.]{1,40})")


class HotFiles:
    """Answers a table's file from memory, and passes every other request on.

    Parameters
    ----------
    app : ASGI application
    library : Library
    cache_control : bytes
        Of the files: immutable.
    """

    def __init__(self, app: ASGIApp, library: Library, cache_control: bytes) -> None:
        self._app, self._library, self._cache_control = app, library, cache_control

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer, or pass the request on."""
        answer = self._answer(scope) if scope["method"] == "GET" else None
        if answer is None:
            await self._app(scope, receive, send)
        else:
            scope[TEMPLATE] = TABLE_FILE
            await answer(scope, receive, send)

    def _answer(self, scope: Scope) -> FileResponse | None:
        match = _PATH.fullmatch(scope["path"])
        if match is None or scope["query_string"]:
            return None
        table_id, suffix = match.groups()
        entry = self._library.hot(table_id, suffix)
        if entry is None or format_of_suffix(suffix).name in COMPRESSED:
            return None
        return FileResponse(representation(entry, table_id, suffix, self._cache_control))
