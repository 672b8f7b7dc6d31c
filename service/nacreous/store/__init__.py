"""Finished files, kept by the id of their table on any fsspec URL."""
