"""Send schemathesis' cases at the edges of every schema: `python -m contract_cases URL CASES`.

There are some 16,000 of them; of each operation's an equal share is sent, spread evenly over all. Prints how
many, by operation and by status, as JSON; ends with 1 at the first failure, with what schemathesis says.
"""

import json
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any

import schemathesis
from schemathesis import Case, GenerationMode
from schemathesis.checks import CHECKS
from schemathesis.core.failures import FailureGroup

import schemathesis_hooks  # noqa: F401 - it says how TOML is sent

__all__ = ["LEFT_OUT"]

LEFT_OUT = ("positive_data_acceptance", "use_after_free")
"""A spec may fit its schema and still be none: physics is not written in JSON Schema. And DELETE of a job
ends it, after which it is there to be looked at."""

_MODES = [GenerationMode.POSITIVE, GenerationMode.NEGATIVE]


def main() -> None:
    """Send, check and count."""
    location, wanted = sys.argv[1], int(sys.argv[2])
    schema = schemathesis.openapi.from_url(f"{location}/openapi.json")
    operations = [result.ok() for result in schema.get_all_operations()]
    cases = [list(_cases(schema, operation)) for operation in operations]
    counts, statuses = Counter[str](), Counter[int]()
    for case in _shares(cases, wanted):
        response = case.call(base_url=location, timeout=60)
        try:
            case.validate_response(response, checks=_checks())
        except FailureGroup as group:
            sys.exit("\n\n".join(map(str, group.exceptions)))
        counts[case.operation.label] += 1
        statuses[response.status_code] += 1
    print(json.dumps({"cases": counts.total(), "operations": counts, "statuses": statuses}))


def _cases(schema: Any, operation: Any) -> Iterator[Case]:  # noqa: ANN401 - schemathesis' own types
    configured = schema.config.generation_for(operation=operation, phase="coverage")
    return schema.iter_coverage_cases(operation, generation_modes=_MODES, generation_config=configured)


def _checks() -> list[Any]:
    return CHECKS.get_by_names([name for name in CHECKS.get_all_names() if name not in LEFT_OUT])


def _shares(cases: Sequence[Sequence[Case]], wanted: int) -> Iterator[Case]:
    """Yield as many of each as of any other, or all where there are fewer; the rest is shared again."""
    remaining = wanted
    for place, group in enumerate(sorted(cases, key=len)):
        share = -(-remaining // (len(cases) - place))
        chosen = group[:: max(1, len(group) // share)][:share] if share < len(group) else group
        remaining -= len(chosen)
        yield from chosen


if __name__ == "__main__":
    main()
