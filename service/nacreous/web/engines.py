"""The engine of a service, from its settings."""

from nacreous.engine.engine import Engine
from nacreous.engine.worker_engine import WorkerEngine, WorkerSettings
from nacreous.web.settings import Settings

__all__ = ["GRACE_SECONDS", "worker_engine"]

GRACE_SECONDS = 3.0
"""What a work has left once the service is told to stop and its requests have been waited for."""


def worker_engine(settings: Settings) -> Engine:
    """Return an engine whose worker process is supervised."""
    return WorkerEngine(
        WorkerSettings(
            deadline_s=settings.deadline_seconds, queue_length=settings.queue_length, grace_s=GRACE_SECONDS
        )
    )
