"""Client of a Nacreous service: tables of thin-film interference by HTTP.

>>> from nacreous_client import Client
>>> with Client("http://localhost:8000") as service:  # doctest: +SKIP
...     service.download("soap-bubble", ".exr", "soap-bubble.exr")

`AsyncClient` has the same methods, to be awaited. Nothing here imports anything of Nacreous itself.
"""

from nacreous_client.answers import Failure, Job, JobTable, Material, Optics, Preset, Table
from nacreous_client.client import AsyncClient, Client
from nacreous_client.download import Download
from nacreous_client.errors import (
    AddressError,
    AnswerError,
    BudgetError,
    BusyError,
    ChecksumError,
    DeadlineError,
    JobFailedError,
    KeyRefusedError,
    MissingError,
    ProblemError,
    ServiceError,
    SpecError,
    UnavailableError,
    UnreachableError,
)
from nacreous_client.retry import Retry

__all__ = [
    "AddressError",
    "AnswerError",
    "AsyncClient",
    "BudgetError",
    "BusyError",
    "ChecksumError",
    "Client",
    "DeadlineError",
    "Download",
    "Failure",
    "Job",
    "JobFailedError",
    "JobTable",
    "KeyRefusedError",
    "Material",
    "MissingError",
    "Optics",
    "Preset",
    "ProblemError",
    "Retry",
    "ServiceError",
    "SpecError",
    "Table",
    "UnavailableError",
    "UnreachableError",
]
