"""What schemathesis has to be told: how TOML is sent."""

from typing import Any

import schemathesis


@schemathesis.serializer("application/toml")
def toml(_: Any, value: Any) -> bytes:  # noqa: ANN401 - schemathesis' context, and any value that it made
    """Send a text as it is, and anything else as its text."""
    return value if isinstance(value, bytes) else str(value).encode("utf-8", "surrogatepass")
