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


def test_a_changed_file_is_bad_and_other_kernels_are_a_note(run: Run, tmp_path: Path) -> None:
    """What was edited fails; what another version computed does not, and the line says so."""
    (name,) = run("tabulate", "coated-lens", "--format", "csv").stdout.splitlines()
    file = tmp_path / name
    text = file.read_text("utf-8")
    file.write_text(text.replace("# nacreous:precision = single", "# nacreous:precision = double"), "utf-8")
    done = run("verify", name)
    assert done.returncode == 1
    assert "BAD: nacreous:checksum: expected" in done.stdout
    assert done.stdout.count("\n") == 1


def test_a_damaged_exr_is_one_line(run: Run, tmp_path: Path) -> None:
    """OpenEXR has warnings of its own, which it writes past Python; none comes through."""
    name, _ = run("tabulate", "coated-lens").stdout.splitlines()
    whole = (tmp_path / name).read_bytes()
    for at in (8, 200, len(whole) // 2, len(whole) - 100):
        (tmp_path / name).write_bytes(whole[:at] + b"\xff" * 40 + whole[at + 40 :])
        done = run("verify", name)
        assert (done.returncode, done.stderr) == (1, "")
        assert done.stdout.startswith(f"{name}: BAD: ")
        assert done.stdout.count("\n") == 1
