"""``nacreous verify`` in a shell script."""

import json
import subprocess
from collections.abc import Callable
from pathlib import Path

Run = Callable[..., subprocess.CompletedProcess[str]]


def test_good_files_are_a_line_each_and_exit_code_0(run: Run) -> None:
    """What `tabulate` writes, `verify` finds good."""
    written = run("tabulate", "coated-lens", "--format", "exr", "--format", "csv").stdout.splitlines()
    done = run("verify", *written)
    assert (done.returncode, done.stderr) == (0, "")
    assert len(done.stdout.splitlines()) == len(written) == 3
    assert all(": good: " in line for line in done.stdout.splitlines())


def test_one_bad_file_among_good_ones_is_exit_code_1(run: Run, tmp_path: Path) -> None:
    """Every file is looked at; the bad one has its line as well."""
    written = run("tabulate", "coated-lens", "--format", "npz").stdout.splitlines()
    (tmp_path / "broken.npz").write_bytes((tmp_path / written[0]).read_bytes()[:1000])
    done = run("verify", "broken.npz", *written, "--json")
    assert done.returncode == 1
    broken, good = map(json.loads, done.stdout.splitlines())
    assert (broken["good"], good["good"]) == (False, True)
    assert broken["problems"]
    assert broken["least"] is None
