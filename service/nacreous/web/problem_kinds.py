"""The kinds of problems: the words at the end of their types, and what each says to a person."""

from collections.abc import Mapping
from types import MappingProxyType

__all__ = ["MEANINGS", "PREFIX"]

PREFIX = "urn:nacreous:problem:"

MEANINGS: Mapping[str, str] = MappingProxyType(
    {
        "spec": "A spec, or a parameter of a request, has a wrong value: `field` says which.",
        "document": "The body is no TOML or JSON.",
        "format": "A file cannot be written or read as the format has it.",
        "budget": "The table is larger than the service's memory allows.",
        "missing": "There is nothing at this path, or of this name.",
        "method": "The path does not answer to this method; `Allow` has those that it answers to.",
        "request": "A parameter of the request cannot be used.",
        "media-type": "The body is in no media type that the route reads; `Accept-Post` has those.",
        "body": "The body is larger than the service accepts.",
        "slow-body": "The body did not come in time.",
        "header": "The header is larger than the service accepts.",
        "slow-header": "The header did not come in time.",
        "range": "The range lies beyond the end of the file.",
        "key": "The service wants a key, and got none that it knows.",
        "cors": "Pages of this origin may not ask, or not for this.",
        "busy": "The queue is full: ask again after `Retry-After`.",
        "connections": "Too many connections are open, and this one is closed: come back later.",
        "concurrency": "Too many requests are being answered: ask again after `Retry-After`.",
        "unavailable": "No table can be computed at present: ask again after `Retry-After`.",
        "not-ready": "The service is not ready; `detail` says why.",
        "stopping": "The service is on its way out.",
        "deadline": "The table took longer than it may.",
        "store": "The store could not be read or written.",
        "device": "There is no OpenCL device that can compute.",
        "numerical": "A value breaks the law that it must obey, and the table is not handed out.",
        "http": "HTTP itself refuses the request; the status says why.",
        "internal": "The service has failed at the request; its log says why.",
    }
)
"""What each kind means, for a person."""
