"""``nacreous schema``: the JSON Schema of a spec."""

import json

__all__ = ["schema"]


def schema() -> None:
    """Print the JSON Schema of a spec."""
    from nacreous.tables.spec import json_schema

    print(json.dumps(json_schema(), indent=2))
