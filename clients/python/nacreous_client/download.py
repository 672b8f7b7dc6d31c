"""A file from the service: in full, with the right checksum, or not at all.

The service's ETag is the SHA-256 of the file. What breaks off goes on where it was, by a range that holds for
this ETag alone (RFC 9110, sections 13.1.5 and 14); bytes that are not the file's are dropped and asked for
again.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from http import HTTPStatus
from pathlib import Path

from nacreous_client.answers import Job, parsed
from nacreous_client.errors import AnswerError, ChecksumError, ProblemError
from nacreous_client.exchange import REPEATED, accepted
from nacreous_client.jobs import Progress, succeeded, waited
from nacreous_client.part_file import PartFile
from nacreous_client.retry import Patience, Retry
from nacreous_client.steps import CONTENT, Headers, Pause, Request, Steps

__all__ = ["Download", "Listeners", "Received", "download"]

Received = Callable[[int, int | None], None]
"""Is told how many bytes have come, and of how many, where the service says so."""

_ETAG = re.compile(r'"([0-9a-f]{64})"')
_RANGE = re.compile(r"bytes (\d+)-(\d+)/(\d+)")


@dataclass(frozen=True)
class Download:
    """A file that has come.

    Parameters
    ----------
    path : Path
    sha256 : str
        Its checksum, in hex, that of the service and of the file.
    size_bytes : int
    """

    path: Path
    sha256: str
    size_bytes: int


@dataclass(frozen=True)
class Listeners:
    """Who is told how a download goes: of its bytes, and of the job that makes the file before any come."""

    received: Received | None = None
    progress: Progress | None = None


def download(link: str, path: Path, listeners: Listeners, retry: Retry) -> Steps[Download]:
    """Bring the file at a link to a path; raises `ServiceError` and `OSError`."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = PartFile(path)
    try:
        part.resume()
        job = yield from _arrival(link, part, listeners.received, Patience(retry))
        if job is not None:
            succeeded((yield from waited(job, listeners.progress, retry)))
            job = yield from _arrival(link, part, listeners.received, Patience(retry))
        if job is not None:
            raise AnswerError(f"expected the file that job {job.id[:16]}… has made, got the job once more")
        found = Download(path, part.sha256, part.size)
        part.complete()
    finally:
        part.leave()
    return found


def _arrival(link: str, part: PartFile, received: Received | None, patience: Patience) -> Steps[Job | None]:
    """Ask until all has come, or return the job that the file has to be waited for.

    An attempt that brought something new is none of those that are counted.
    """
    while True:
        before = (part.sha256, part.size)
        try:
            reply = accepted((yield Request("GET", link, _asked(part), receiver=_Arrival(part, received))))
            if reply.status == HTTPStatus.ACCEPTED:
                return parsed(reply.body, lambda body: Job.of(body["job"]))
            _check(part, reply.status)
        except (*REPEATED, ChecksumError) as failure:
            if part.size and (part.sha256, part.size) != before:
                patience.renew()
            wait_s = patience.pause_s(failure)
        except ProblemError as failure:
            if failure.status != HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE or not part.size:
                raise
            part.discard()  # as long as the file, or longer: it is none of it
            continue
        else:
            return None
        yield Pause(wait_s)


def _asked(part: PartFile) -> Headers:
    """Return the headers of a request for what is missing, byte for byte as the checksum is of it."""
    headers = {"Accept": "*/*", "Accept-Encoding": "identity"}
    if part.size:
        headers |= {"Range": f"bytes={part.size}-", "If-Range": f'"{part.sha256}"'}
    return headers


def _check(part: PartFile, status: int) -> None:
    """Refuse an answer without a file, and drop a file that is not what the service says.

    Raises
    ------
    AnswerError, ChecksumError
    """
    if status not in CONTENT:
        raise AnswerError(f"expected a file, got an answer {status} without one")
    if not part.intact:
        expected = part.sha256
        part.discard()
        raise ChecksumError(f"expected a file of SHA-256 {expected}, got other bytes")


class _Arrival:
    """Takes one answer's bytes into a part."""

    def __init__(self, part: PartFile, received: Received | None) -> None:
        self._part, self._received = part, received
        self._total: int | None = None

    def begin(self, status: int, headers: Headers) -> None:
        """Begin anew, or where the part ends; raises `AnswerError`."""
        sha256 = _sha256(headers)
        if status == HTTPStatus.PARTIAL_CONTENT:
            self._total = _continued(self._part, sha256, headers.get("Content-Range", ""))
        else:
            self._part.begin(sha256)
            length = headers.get("Content-Length", "")
            self._total = int(length) if length.isdigit() else None

    def feed(self, chunk: bytes) -> bool:
        """Take bytes."""
        self._part.append(chunk)
        if self._received is not None:
            self._received(self._part.size, self._total)
        return True


def _sha256(headers: Headers) -> str:
    """Return the checksum that the service gives of the file; raises `AnswerError`."""
    etag, coding = headers.get("ETag", ""), headers.get("Content-Encoding", "identity")
    match = _ETAG.fullmatch(etag)
    if match is None or coding != "identity":
        remedy = "is it a Nacreous service, with nothing in between that changes its files?"
        raise AnswerError(
            f"expected an ETag that is the SHA-256 of the file, got {etag[:80]!r} ({coding}): {remedy}"
        )
    return match[1]


def _continued(part: PartFile, sha256: str, content_range: str) -> int:
    """Return the size of the whole; raises `AnswerError` where these are not the bytes asked for."""
    match = _RANGE.fullmatch(content_range)
    if match is None or int(match[1]) != part.size or sha256 != part.sha256:
        raise AnswerError(f"expected bytes from {part.size} on, got {content_range[:80]!r}")
    return int(match[3])
