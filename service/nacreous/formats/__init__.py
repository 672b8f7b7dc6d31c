"""From a table to a file: one module a format, one registry of them all."""
