"""What a client can do, defined once for the one that blocks and the one that is awaited."""

import re
from collections.abc import Mapping
from http import HTTPStatus
from pathlib import Path
from typing import Any
from urllib.parse import quote, urlencode

import httpx

from nacreous_client.answers import Job, Material, Preset, Table, parsed
from nacreous_client.download import Download, Listeners, Received, download
from nacreous_client.errors import AddressError, without_user_info
from nacreous_client.exchange import asked, exchange, posted
from nacreous_client.jobs import Progress, found, job_path, succeeded, waited
from nacreous_client.retry import Retry
from nacreous_client.steps import Operation, Request, Steps

__all__ = ["Operations"]

_TIMEOUT = httpx.Timeout(10.0, read=90.0)
"""Seconds without a byte. A table may take a minute before the first byte of its answer."""

_PAGE = 1000
"""Materials of an answer."""
_TABLE_ID = re.compile(r"[0-9a-f]{64}")


class Operations:
    """What both clients can do.

    Parameters
    ----------
    url : str
        Where the service is, such as ``"http://localhost:8000"``; a path in front of its own is kept.
    key : str, optional
        Bearer key.
    retry : Retry, optional
        What to do about a service that is busy, unavailable or out of reach.

    Raises
    ------
    AddressError
        The address or the key cannot be one.
    """

    def __init__(self, url: str, key: str | None = None, retry: Retry | None = None) -> None:
        self.address = _checked_address(url)
        self.retry = retry or Retry()
        self._options: dict[str, Any] = {
            "headers": {"Accept": "application/json", **_authorisation(key)},
            "timeout": _TIMEOUT,
            "follow_redirects": True,
        }

    @Operation
    def tabulate(self, spec: Mapping[str, Any], progress: Progress | None = None) -> Steps[Table]:
        """Have a spec computed, and return its table.

        Parameters
        ----------
        spec : mapping
            The fields of a spec, as a JSON document has them.
        progress : callable, optional
            Called with the `Job` that a table of some time becomes, whenever it changes.

        Raises
        ------
        SpecError, BudgetError
            The spec is wrong, or its table too large.
        JobFailedError
            The table took some time, and could not be made.
        ServiceError
            Anything else.
        """
        reply = yield from posted("/v1/tables", spec, self.retry)
        if reply.status != HTTPStatus.ACCEPTED:
            return parsed(reply.body, Table.of)
        job, link = parsed(reply.body, lambda body: (Job.of(body["job"]), str(body["links"]["table"])))
        succeeded((yield from waited(job, progress, self.retry)))
        return (yield from asked(link, Table.of, self.retry))

    @Operation
    def table(self, id: str) -> Steps[Table]:  # noqa: A002 - the service's word for it
        """Return a table that the service has; raises `MissingError` where it has none of this id."""
        return (yield from asked(f"/v1/tables/{quote(id, safe='')}", Table.of, self.retry))

    @Operation
    def download(
        self,
        source: str,
        suffix: str,
        to: str | Path,
        received: Received | None = None,
        progress: Progress | None = None,
    ) -> Steps[Download]:
        """Bring a file of a table or of a preset to a path.

        Parameters
        ----------
        source : str
            Id of a table, or name of a preset.
        suffix : str
            Of the file, such as ``".exr"`` or ``".transmission.exr"``.
        to : str or Path
            The file; what was there before stays until the new one is complete. Folders are made.
        received : callable, optional
            Called with the bytes that have come and, where the service says so, those of the whole.
        progress : callable, optional
            Called with the `Job` that a file of some time becomes, whenever it changes.

        Raises
        ------
        MissingError
            There is no such table, preset or file.
        ChecksumError
            Other bytes came than the service has sent, time and again.
        ServiceError, OSError
            Anything else; what has come is kept, hidden, and a later call goes on with it.
        """
        listeners = Listeners(received, progress)
        return (yield from download(_file_path(source, suffix), Path(to), listeners, self.retry))

    @Operation
    def fetch(
        self,
        link: str,
        to: str | Path,
        received: Received | None = None,
        progress: Progress | None = None,
    ) -> Steps[Download]:
        """Bring the file at one of the service's links to a path; the rest is as of `download`."""
        return (yield from download(link, Path(to), Listeners(received, progress), self.retry))

    @Operation
    def presets(self) -> Steps[tuple[Preset, ...]]:
        """Return the service's presets."""
        return (yield from asked("/v1/presets", _presets, self.retry))

    @Operation
    def preset(self, name: str) -> Steps[Preset]:
        """Return a preset with its spec; raises `MissingError`."""
        return (yield from asked(f"/v1/presets/{quote(name)}", Preset.of, self.retry))

    @Operation
    def materials(self, search: str) -> Steps[tuple[Material, ...]]:
        """Return the materials whose name, description or citation holds every word."""
        listed: list[Material] = []
        while True:
            query = urlencode({"search": search, "offset": len(listed), "limit": _PAGE})
            page = yield from asked(f"/v1/materials?{query}", _materials, self.retry)
            listed += page
            if len(page) < _PAGE:
                return tuple(listed)

    @Operation
    def material(self, name: str) -> Steps[Material]:
        """Return a material with its n and k; raises `MissingError` or `SpecError`."""
        return (yield from asked(f"/v1/materials/{quote(name)}", Material.of, self.retry))

    @Operation
    def submit(self, sweep: Mapping[str, Any]) -> Steps[Job]:
        """Have the tables of a sweep computed, and return the job at once.

        A sweep that the service has already is the same job.
        """
        reply = yield from posted("/v1/jobs", sweep, self.retry)
        return parsed(reply.body, Job.of)

    @Operation
    def job(self, job: Job | str) -> Steps[Job]:
        """Return how a job is now; raises `MissingError`."""
        return (yield from found(job, self.retry))

    @Operation
    def wait(self, job: Job | str, progress: Progress | None = None) -> Steps[Job]:
        """Return a job once it has ended, however it has; its `failures` say what could not be made."""
        return (yield from waited(job, progress, self.retry))

    @Operation
    def cancel(self, job: Job | str) -> Steps[None]:
        """End a job; the tables that it has made stay."""
        yield from exchange(Request("DELETE", job_path(job)), self.retry)


def _presets(body: Any) -> tuple[Preset, ...]:  # noqa: ANN401 - any document
    listed = body["presets"] if isinstance(body, dict) else body
    return tuple(map(Preset.of, listed))


def _materials(body: Any) -> tuple[Material, ...]:  # noqa: ANN401 - any document
    return tuple(map(Material.of, body["materials"]))


def _file_path(source: str, suffix: str) -> str:
    shelf = "tables" if _TABLE_ID.fullmatch(source) else "presets"
    return f"/v1/{shelf}/{quote(source)}{quote(suffix)}"


def _checked_address(url: str) -> str:
    try:
        parts = httpx.URL(url)
    except (httpx.InvalidURL, TypeError):
        parts = httpx.URL("")
    if parts.scheme not in {"http", "https"} or not parts.host or parts.query or parts.fragment:
        got = without_user_info(str(url))
        raise AddressError(f"expected an address such as http://localhost:8000, got {got!r}")
    return url.rstrip("/")


def _authorisation(key: str | None) -> dict[str, str]:
    if not key:
        return {}
    if not (key.isascii() and key.isprintable() and " " not in key):
        raise AddressError("expected a key of visible ASCII characters, got one with others")
    return {"Authorization": f"Bearer {key}"}
