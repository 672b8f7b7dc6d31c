"""A job as it is at one moment, and the manifest that the store keeps of it."""

import json
import re
from dataclasses import dataclass
from datetime import UTC, datetime
from enum import StrEnum
from typing import Any, Self

from nacreous.engine.sweep import Sweep
from nacreous.errors import MissingError
from nacreous.store.entry import Entry

__all__ = ["JOBS", "Failure", "Job", "JobState", "Manifest", "manifest_key"]

JOBS = "jobs/"
"""What the keys of all manifests begin with."""
FAILURES_TOLD = 20
_JOB_ID = re.compile("[0-9a-f]{64}")


class JobState(StrEnum):
    """How far a job is."""

    QUEUED = "queued"
    RUNNING = "running"
    DONE = "done"
    FAILED = "failed"
    CANCELLED = "cancelled"


@dataclass(frozen=True)
class Failure:
    """A table that could not be made: its index in the sweep, and why."""

    spec: int
    message: str


@dataclass(frozen=True)
class Job:
    """A job as it is at one moment.

    Parameters
    ----------
    id : str
        Id of the sweep.
    state : JobState
        Done also where some tables failed; failed where none could be made, or where the store failed.
    total : int
        Tables of the sweep.
    created : datetime
        In UTC.
    done, failed : int
        Tables that are finished, and those that could not be made.
    failures : tuple of Failure
        The first few of them.
    formats : tuple of str
        Names of the formats; none stands for the default format of each table.
    tables : tuple of str
        Ids of the tables that are finished, in the order of the sweep.
    specs : tuple of int
        Index of each of them in the sweep: those that could not be made are passed over.
    files : tuple of str
        Names of their files, one a format, such as ``"ab12….exr"``.
    fraction : float
        How much is done, 0 to 1, of the table in hand as well.
    error : str
        Why the job as a whole failed.
    """

    id: str
    state: JobState
    total: int
    created: datetime
    done: int = 0
    failed: int = 0
    failures: tuple[Failure, ...] = ()
    formats: tuple[str, ...] = ()
    tables: tuple[str, ...] = ()
    specs: tuple[int, ...] = ()
    files: tuple[str, ...] = ()
    fraction: float = 0.0
    error: str = ""

    @property
    def ended(self) -> bool:
        """Whether the state is the last."""
        return self.state in (JobState.DONE, JobState.FAILED, JobState.CANCELLED)

    @classmethod
    def of(cls, sweep: Sweep) -> Self:
        """Return the job of a sweep, in the queue since now."""
        return cls(sweep.id, JobState.QUEUED, len(sweep), datetime.now(UTC), formats=sweep.formats)


@dataclass(frozen=True)
class Manifest:
    """What is kept of a job: its sweep's document, and the job, whose progress is in the store itself."""

    job: Job
    document: dict[str, Any]

    def to_entry(self) -> Entry:
        """Return the entry that the store keeps."""
        job = {**vars(self.job), "created": self.job.created.isoformat()}
        job["failures"] = [vars(failure) for failure in self.job.failures]
        payload = json.dumps({"job": job, "sweep": self.document}).encode()
        return Entry({"media_type": "application/json"}, payload)

    @classmethod
    def from_entry(cls, entry: Entry) -> Self:
        """Return the manifest in an entry; raises `ValueError` where it is of another version."""
        try:
            content = json.loads(entry.payload)
            job = content["job"]
            for name in ("formats", "tables", "specs", "files"):
                job[name] = tuple(job[name])
            job["failures"] = tuple(Failure(**failure) for failure in job["failures"])
            job["state"] = JobState(job["state"])
            job["created"] = datetime.fromisoformat(job["created"])
            return cls(Job(**job), content["sweep"])
        except (KeyError, TypeError) as error:
            raise ValueError(f"the manifest of a job is of another version: {error}") from None


def manifest_key(job_id: str) -> str:
    """Return the key of a job's manifest; raises `MissingError` for what cannot be a job's id."""
    if not _JOB_ID.fullmatch(job_id):
        raise MissingError("there is no such job: an id has 64 digits, 0 to 9 and a to f")
    return JOBS + job_id
