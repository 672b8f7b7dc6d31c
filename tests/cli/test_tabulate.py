"""``nacreous tabulate`` as a pipeline calls it."""

import hashlib
import json
import os
import pty
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from nacreous.formats.registry import FORMATS
from nacreous.formats.verify import verify
from spec_texts import FILM, ROUGH

Run = Callable[..., subprocess.CompletedProcess[str]]


def test_writes_an_exr_and_prints_its_path(run: Run, tmp_path: Path) -> None:
    """The default format; a preset's name with its slash replaced; nothing on stderr in a pipe."""
    done = run("tabulate", "paper/figure-3", "--set", "table.cos_theta=5")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines() == ["paper-figure-3.exr", "paper-figure-3.transmission.exr"]
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(done.stdout.splitlines())


@pytest.mark.parametrize(("text", "quantity"), [(FILM, "fresnel"), (ROUGH, "bsdf")])
def test_writes_every_format_into_a_folder_that_it_makes(
    run: Run, tmp_path: Path, text: str, quantity: str
) -> None:
    """A spec file's name is the files' name; a format asked for twice, or a file of two, is told once."""
    (tmp_path / "my.film.toml").write_text(text)
    able = {name: chosen for name, chosen in FORMATS.items() if quantity in chosen.quantities}
    options = [option for name in (*able, "exr") for option in ("--format", name)]
    done = run("tabulate", "my.film.toml", *options, "-o", "made/here")
    assert done.returncode == 0, done.stderr
    written = [tmp_path / line for line in done.stdout.splitlines()]
    assert sorted(written) == sorted((tmp_path / "made" / "here").iterdir())
    for name, chosen in able.items():
        assert tmp_path / "made" / "here" / f"my.film{chosen.suffix}" in written, name
    assert all(verify(path).good for path in written)


def test_json_is_one_object_a_line_and_nothing_else(run: Run, tmp_path: Path) -> None:
    """A program needs no more than these to trust a file and to file it."""
    (tmp_path / "film.toml").write_text(FILM)
    done = run("tabulate", "film.toml", "--format", "npz", "--format", "png", "--json")
    assert done.stderr == ""
    records = [json.loads(line) for line in done.stdout.splitlines()]
    assert [record["format"] for record in records] == ["npz", "png", "png"]
    for record in records:
        assert set(record) == {"path", "format", "id", "sha256", "seconds", "certificate"}
        assert record["sha256"] == hashlib.sha256((tmp_path / record["path"]).read_bytes()).hexdigest()
        assert record["id"] == verify(tmp_path / record["path"]).id
        assert record["certificate"]["nonfinite"] == 0


def test_the_same_spec_gives_the_same_bytes(run: Run) -> None:
    """Over processes as well: nothing of the time, the folder or the run is in a file."""
    digests = {
        record["sha256"]
        for folder in ("a", "b")
        for line in run("tabulate", "coated-lens", "-o", folder, "--json").stdout.splitlines()
        if "transmission" not in (record := json.loads(line))["path"]
    }
    assert len(digests) == 1


def test_an_option_changes_the_spec(run: Run) -> None:
    """A change of the spec is a change of the table's id."""
    ids = [
        json.loads(run("tabulate", "paper/figure-3", "--json", *change).stdout.splitlines()[0])["id"]
        for change in (["--set", "table.cos_theta=5"], ["--set", "table.cos_theta=6"])
    ]
    assert ids[0] != ids[1]


@pytest.mark.parametrize("folder", ["film.toml", "film.toml/below", "n" * 300, "/dev/null/here"])
def test_a_folder_that_cannot_be_written_is_refused_at_once(run: Run, tmp_path: Path, folder: str) -> None:
    """One message that names the option; what was there is as it was."""
    (tmp_path / "film.toml").write_text(FILM)
    done = run("tabulate", "film.toml", "-o", folder)
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.count("\n") == 1
    assert "--output: expected a folder that can be written, got " in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["film.toml"]


def test_a_table_beyond_the_budget_is_refused_before_it_is_made(run: Run, tmp_path: Path) -> None:
    """The message has the size and the limit; the folder is not even made."""
    axes = [
        "--set",
        "table.cos_theta=60000",
        "--set",
        "table.thickness_scale={start=0.5,stop=1.5,count=60000}",
    ]
    done = run("tabulate", "paper/figure-3", *axes, "--format", "npz", "-o", "out")
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert done.stderr.count("MiB") == 2
    assert list(tmp_path.iterdir()) == []


LARGE = (
    "tabulate", "soap-bubble", "-o", "out",
    "--set", "table.cos_theta=4000", "--set", "table.thickness_scale={start=0.5,stop=1.5,count=4000}",
)  # fmt: skip


def test_an_interrupt_on_a_terminal_ends_it_with_130(program: tuple[str, ...], tmp_path: Path) -> None:
    """On a terminal there is a progress bar; once it shows, Ctrl-C stops the work and leaves nothing."""
    terminal, stderr = pty.openpty()
    with subprocess.Popen([*program, *LARGE], cwd=tmp_path, stdout=subprocess.PIPE, stderr=stderr) as child:
        os.close(stderr)
        shown = b""
        while b"tabulating" not in shown:
            shown += os.read(terminal, 1024)
        child.send_signal(signal.SIGINT)
        assert child.stdout is not None
        assert child.stdout.read() == b""
        _drain(terminal)
    assert child.returncode == 130
    assert list(tmp_path.iterdir()) == []


def test_an_interrupt_in_a_pipe_ends_it_with_130_and_one_line(
    program: tuple[str, ...], tmp_path: Path
) -> None:
    """Linux lists the libraries that a process has mapped: with OpenCL's, the work has begun."""
    with subprocess.Popen(
        [*program, *LARGE], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as child:
        while not _has_opened_a_device(child.pid):
            assert child.poll() is None
        child.send_signal(signal.SIGINT)
        out, err = child.communicate()
    assert (child.returncode, out, err) == (130, b"", b"nacreous: interrupted\n")
    assert list(tmp_path.iterdir()) == []


def _has_opened_a_device(pid: int) -> bool:
    return "pocl" in Path(f"/proc/{pid}/maps").read_text()


def _drain(terminal: int) -> None:
    """Read a terminal until its last writer has gone, which Linux reports as EIO."""
    try:
        while os.read(terminal, 1024):
            pass
    except OSError:
        os.close(terminal)
