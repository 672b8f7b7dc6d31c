"""How fast the service answers, beside plain programs in the same server: `python -m load`, tests on the path."""
