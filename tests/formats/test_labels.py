"""A file is that of its table's id, whatever the table was called by who asked for it."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from nacreous.formats.registry import FORMATS
from nacreous.tables.spec import LABELS
from nacreous.tables.table import Table


@pytest.mark.parametrize("name", FORMATS)
def test_labels_change_no_byte(name: str, held: Callable[[str], Table], tmp_path: Path) -> None:
    """The same id is the same bytes: a service keeps one file for all who ask, under any label."""
    table = held(name)
    other = replace(table, spec=table.spec.model_copy(update=dict.fromkeys(LABELS, "another label")))
    files = []
    for folder, each in (("a", table), ("b", other)):
        (tmp_path / folder).mkdir()
        written = FORMATS[name].write(each, tmp_path / folder / f"film{FORMATS[name].suffix}")
        files.append({path.name: path.read_bytes() for path in written})
    assert files[0] == files[1]
