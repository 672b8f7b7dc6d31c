"""From a spec to a table of values."""
