"""Variables of the environment that look like settings, and are none: a slip of the keyboard is told."""

import difflib
from collections.abc import Iterable, Iterator

from nacreous.web.settings import Settings

__all__ = ["KNOWN", "unknown_variables"]

_PREFIX = "NACREOUS_"
_ELSEWHERE = (
    *("NACREOUS_BYTE_BUDGET", "NACREOUS_DEVICE"),  # of every command
    *("NACREOUS_SERVER", "NACREOUS_SERVER_KEY"),  # of the commands that ask a service
    *("NACREOUS_WORKER_MEMORY", "NACREOUS_WORKER_PARENT"),  # of the worker process
    *("NACREOUS_SOAK", "NACREOUS_BLENDER_PYTHON"),  # of the tests
)
KNOWN = (*(f"{_PREFIX}{name.upper()}" for name in Settings.model_fields), *_ELSEWHERE)
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
