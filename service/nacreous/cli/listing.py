"""Rows for a person or for a program."""

import json
from collections.abc import Iterable, Mapping

__all__ = ["Row", "print_columns", "print_json_lines"]

Row = Mapping[str, object]


def print_json_lines(rows: Iterable[Row]) -> None:
    """Print each row as one line of JSON."""
    for row in rows:
        print(json.dumps(row, allow_nan=False))


def print_columns(rows: Iterable[Row]) -> None:
    """Print rows one under the other, every column but the last as wide as its widest value."""
    lines = [[str(value) for value in row.values()] for row in rows]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    for line in lines:
        cells = [cell.ljust(width) for cell, width in zip(line, widths, strict=True)]
        print("  ".join(cells).rstrip())
