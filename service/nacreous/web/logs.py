"""Logs as one line of JSON each: what happened, and never a header, a key, a body or a raw path."""

import asyncio
import json
import logging
import logging.config
import time
from datetime import UTC, datetime
from functools import lru_cache
from typing import TextIO

__all__ = ["JsonFormatter", "RequestRecord", "TogetherHandler", "configure", "log_request"]

_LOGGER = logging.getLogger("nacreous.web")
_FACTS = "facts"
"""The attribute of a record that holds further fields of its line."""
_TOGETHER_S = 0.02


class JsonFormatter(logging.Formatter):
    """A record as one line of JSON."""

    def format(self, record: logging.LogRecord) -> str:
        """Return the line; a traceback is one field of it."""
        if isinstance(record, RequestRecord):
            return record.line()
        line = {
            "time": _time(record.created),
            "level": record.levelname.lower(),
            "logger": record.name,
            "event": record.getMessage(),
            **getattr(record, _FACTS, {}),
        }
        if record.exc_info:
            line["traceback"] = self.formatException(record.exc_info)
        return json.dumps(line)


def _time(seconds: float) -> str:
    return f"{_second(int(seconds))}.{int(seconds % 1 * 1e3):03d}+00:00"


@lru_cache(maxsize=2)
def _second(seconds: int) -> str:
    return datetime.fromtimestamp(seconds, UTC).strftime("%Y-%m-%dT%H:%M:%S")


class TogetherHandler(logging.StreamHandler[TextIO]):
    """Writes what is logged within 20 ms of an event loop together; warnings, and other threads', at once."""

    def __init__(self) -> None:
        super().__init__()
        self._lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Keep the line, and see to it that it is written soon."""
        try:
            self._lines.append(self.format(record))
        except Exception:  # noqa: BLE001 - logging's own way to say that a line cannot be made
            self.handleError(record)
            return
        loop = asyncio._get_running_loop()  # which raises nothing where there is none
        if loop is None or record.levelno > logging.INFO:
            self.flush()
        elif len(self._lines) == 1:
            loop.call_later(_TOGETHER_S, self.flush)

    def flush(self) -> None:
        """Write what has been kept."""
        self.acquire()
        try:
            lines, self._lines = self._lines, []
            if lines:
                self.stream.write("\n".join(lines) + "\n")
                self.stream.flush()
        finally:
            self.release()


class RequestRecord(logging.LogRecord):
    """A request, without all that a record finds out of its caller and of its thread: every request pays.

    Its line is put together rather than encoded, which would take a quarter of the way of a file in memory.
    """

    name, msg, args = _LOGGER.name, "request", None
    levelname, levelno = "INFO", logging.INFO
    pathname, filename, module, lineno = __file__, "logs.py", "logs", 0
    exc_info = exc_text = stack_info = None

    def __init__(
        self, request_id: str, method: str, route: str, status: int, seconds: float, sent_bytes: int
    ) -> None:
        self.created = time.time()
        self._strings = _quoted(request_id), _quoted_known(method), _quoted_known(route)
        self._numbers = status, round(seconds * 1e3, 2), sent_bytes

    def line(self) -> str:
        """Return the line of JSON."""
        request_id, method, route = self._strings
        status, ms, sent_bytes = self._numbers
        return (
            f'{{"time": "{_time(self.created)}", "level": "info", "logger": "{self.name}", '
            f'"event": "{self.msg}", "id": {request_id}, "method": {method}, "route": {route}, '
            f'"status": {status}, "ms": {ms}, "bytes": {sent_bytes}}}'
        )


_quoted = json.encoder.encode_basestring_ascii
_quoted_known = lru_cache(maxsize=256)(_quoted)


def configure(level: str) -> None:
    """Send every log of this process to stderr in this form, uvicorn's included."""
    logging.captureWarnings(capture=True)
    logging.config.dictConfig(
        {
            "version": 1,
            "disable_existing_loggers": False,
            "formatters": {"json": {"()": JsonFormatter}},
            "handlers": {"stderr": {"()": TogetherHandler, "formatter": "json"}},
            "root": {"handlers": ["stderr"], "level": level.upper()},
        }
    )


def log_request(
    request_id: str, method: str, route: str, status: int, seconds: float, sent_bytes: int
) -> None:
    """Log one request: the route's template, never the path itself."""
    if _LOGGER.isEnabledFor(logging.INFO):
        _LOGGER.handle(RequestRecord(request_id, method, route, status, seconds, sent_bytes))
