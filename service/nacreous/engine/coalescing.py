"""One computation for all who ask for the same while it is under way."""

__all__: list[str] = []
