"""Variables of the environment that look like settings, and are none: a slip of the keyboard is told."""

import difflib
from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType

from nacreous.web.settings import Settings

__all__ = ["ELSEWHERE", "KNOWN", "unknown_variables"]

_PREFIX = "NACREOUS_"
ELSEWHERE: Mapping[str, str] = MappingProxyType(
    {
        "NACREOUS_BYTE_BUDGET": "The most memory that a table may take, such as `500M` or `4GiB`; 2 GiB "
        "without it. Of every command.",
        "NACREOUS_DEVICE": "The OpenCL device: `0:0`, as `nacreous devices` lists it, or a part of its name; "
        "PoCL on the CPU without it. Of every command.",
        "NACREOUS_SERVER": "Address of a service that computes in place of this computer. Of the commands "
        "that ask a service.",
        "NACREOUS_SERVER_KEY": "The key that this service wants.",
        "NACREOUS_WORKER_MEMORY": "Bytes of address space of the worker process; the service sets it.",
        "NACREOUS_WORKER_PARENT": "Process whose end ends the worker; the service sets it.",
        "NACREOUS_SOAK": "Set, it lets the tests inject faults as often as the promises say.",
        "NACREOUS_BLENDER_PYTHON": "Interpreter that has Blender's module, for the tests.",
    }
)
"""The variables that are no settings of the service, and what each says."""
KNOWN = (*(f"{_PREFIX}{name.upper()}" for name in Settings.model_fields), *ELSEWHERE)
"""Every variable that some part of Nacreous reads."""

_FOREIGN = ("NACREOUS_SERVICE_", "NACREOUS_PORT_")
"""What Kubernetes sets for a service of this name (its documentation, "Environment variables")."""


def unknown_variables(names: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Yield each variable that nothing of Nacreous reads, with the remedy: the nearest that something does.

    >>> list(unknown_variables(["NACREOUS_DEADLINE_SECOND", "NACREOUS_PORT", "PATH"]))
    [('NACREOUS_DEADLINE_SECOND', 'did you mean NACREOUS_DEADLINE_SECONDS?')]
    """
    for name in sorted(names):
        if name.startswith(_PREFIX) and name not in KNOWN and not name.startswith(_FOREIGN):
            yield name, _nearest(name)


def _nearest(name: str) -> str:
    """Return the remedy, by what comes after the prefix, in which all names are alike."""
    known = [each.removeprefix(_PREFIX) for each in KNOWN]
    nearest = difflib.get_close_matches(name.removeprefix(_PREFIX), known, n=1)
    return f"did you mean {_PREFIX}{nearest[0]}?" if nearest else "docs/service.md lists the settings"
