"""How fast the service answers, beside starlette alone in the same server: `python -m load`."""
