"""Logs as one line of JSON each: what happened, and never a header, a key, a body or a raw path."""

import json
import logging
import logging.config
from datetime import UTC, datetime

__all__ = ["JsonFormatter", "configure", "log_request"]

_LOGGER = logging.getLogger("nacreous.web")
_FACTS = "facts"
"""The attribute of a record that holds further fields of its line."""


class JsonFormatter(logging.Formatter):
    """A record as one line of JSON."""

    def format(self, record: logging.LogRecord) -> str:
        """Return the line; a traceback is one field of it."""
        line = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
            "event": record.getMessage(),
            **getattr(record, _FACTS, {}),
        }
        if record.exc_info:
            line["traceback"] = self.formatException(record.exc_info)
        return json.dumps(line)


def configure(level: str) -> None:
    """Send every log of this process to stderr in this form, uvicorn's included."""
    logging.config.dictConfig(
        {
            "version": 1,
            "disable_existing_loggers": False,
            "formatters": {"json": {"()": JsonFormatter}},
            "handlers": {"stderr": {"class": "logging.StreamHandler", "formatter": "json"}},
            "root": {"handlers": ["stderr"], "level": level.upper()},
        }
    )


def log_request(
    request_id: str, method: str, route: str, status: int, seconds: float, sent_bytes: int
) -> None:
    """Log one request: the route's template, never the path itself."""
    if not _LOGGER.isEnabledFor(logging.INFO):
        return
    facts = {
        "id": request_id,
        "method": method,
        "route": route,
        "status": status,
        "ms": round(seconds * 1e3, 2),
        "bytes": sent_bytes,
    }
    # Without looking for who calls, which `Logger.info` does and every request would pay for.
    record = logging.LogRecord(_LOGGER.name, logging.INFO, __file__, 0, "request", None, None)
    setattr(record, _FACTS, facts)
    _LOGGER.handle(record)
