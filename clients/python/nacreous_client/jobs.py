"""Jobs: what becomes of a sweep, told by the service as it happens (server-sent events)."""

from collections.abc import Callable
from dataclasses import replace
from urllib.parse import quote

from nacreous_client.answers import Job, parsed
from nacreous_client.errors import JobFailedError, ServiceError, UnreachableError
from nacreous_client.exchange import REPEATED, accepted, asked
from nacreous_client.retry import Patience, Retry
from nacreous_client.steps import Headers, Pause, Request, Steps

__all__ = ["Progress", "found", "job_path", "succeeded", "waited"]

_PAGE = 1000
"""Tables of an answer."""

Progress = Callable[[Job], None]
"""Is told how a job is, whenever that changes."""


def job_path(job: Job | str) -> str:
    """Return where a job is."""
    return f"/v1/jobs/{quote(job.id if isinstance(job, Job) else job, safe='')}"


def found(job: Job | str, retry: Retry) -> Steps[Job]:
    """Return a job with all of its tables, which the service gives by the page."""
    now = yield from asked(f"{job_path(job)}?limit={_PAGE}", Job.of, retry)
    page = now.tables
    while len(page) == _PAGE:
        link = f"{job_path(job)}?offset={len(now.tables)}&limit={_PAGE}"
        page = (yield from asked(link, Job.of, retry)).tables
        now = replace(now, tables=now.tables + page)
    return now


def waited(job: Job | str, progress: Progress | None, retry: Retry) -> Steps[Job]:
    """Return a job once it has ended, however it has.

    A stream of events that breaks off, as those of long jobs do in proxies, is opened again.
    """
    patience = Patience(retry)
    while True:
        events = _Events(progress)
        failure: ServiceError = UnreachableError("", "the events of the job broke off")
        try:
            accepted((yield _listening(job, events)))
        except REPEATED as broken:
            failure = broken
        if events.last is not None and events.last.finished:
            return (yield from found(job, retry))
        if events.last is not None:
            patience.renew()
        yield Pause(patience.pause_s(failure))


def _listening(job: Job | str, events: "_Events") -> Request:
    return Request("GET", f"{job_path(job)}/events", {"Accept": "text/event-stream"}, receiver=events)


class _Events:
    """Takes a stream of events, whose data are jobs (HTML Living Standard, 9.2)."""

    def __init__(self, progress: Progress | None) -> None:
        self.last: Job | None = None
        self._progress = progress
        self._buffer = b""

    def begin(self, status: int, headers: Headers) -> None:
        """Take note of nothing: any answer may be a stream."""

    def feed(self, chunk: bytes) -> bool:
        """Take bytes, tell of each complete event, and stop after the one that is the last."""
        *complete, self._buffer = (self._buffer + chunk).replace(b"\r\n", b"\n").split(b"\n\n")
        for event in complete:
            self._tell(event)
        return self.last is None or not self.last.finished

    def _tell(self, event: bytes) -> None:
        lines = [
            line.removeprefix(b"data:").strip() for line in event.split(b"\n") if line.startswith(b"data:")
        ]
        if not lines:
            return  # a comment that keeps the connection open
        self.last = parsed(b"\n".join(lines), Job.of)
        if self._progress is not None:
            self._progress(self.last)


def succeeded(job: Job) -> Job:
    """Return a job that has its tables; raises `JobFailedError` with the first reason otherwise."""
    if job.state == "done" and not job.failures:
        return job
    reasons = [failure.message for failure in job.failures]
    raise JobFailedError((reasons or [job.error or f"job {job.id[:16]}… ended as {job.state}"])[0])
