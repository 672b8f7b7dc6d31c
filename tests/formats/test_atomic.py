"""No fault leaves half a file: real processes are killed, real writes fail."""

import errno
import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from nacreous.errors import FileFormatError
from nacreous.formats.atomic import replacing
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS
from nacreous.formats.verify import verify
from nacreous.tables.sampling import Sampling
from nacreous.tables.table import Table, Variable


def test_replaces_a_file_only_when_the_new_one_is_complete(tmp_path: Path) -> None:
    """Until the end of the block a reader sees the old file, and afterwards the new one."""
    path = tmp_path / "film.exr"
    path.write_text("old")
    with replacing(path) as (temporary,):
        temporary.write_text("new")
        assert path.read_text() == "old"
    assert path.read_text() == "new"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("failure", [ValueError, KeyboardInterrupt, SystemExit])
def test_what_fails_changes_nothing(tmp_path: Path, failure: type[BaseException]) -> None:
    """Errors and interrupts alike: the old file stays, and no other is left."""
    old, other = tmp_path / "film.exr", tmp_path / "film.transmission.exr"
    old.write_text("old")
    with pytest.raises(failure), replacing(old, other) as temporaries:
        _write_half(temporaries[0], failure)
    assert old.read_text() == "old"
    assert list(tmp_path.iterdir()) == [old]


def _write_half(path: Path, failure: type[BaseException]) -> None:
    path.write_text("half")
    raise failure


def write_new(*paths: Path, obsolete: Sequence[Path] = ()) -> None:
    """Replace files by such that say "new"."""
    with replacing(*paths, obsolete=obsolete) as temporaries:
        for temporary in temporaries:
            temporary.write_text("new")


def refusing_second(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make the rename to any ``.transmission`` file fail, as on a disk that is taken away in between."""
    rename = Path.replace

    def replace(self: Path, target: Path) -> Path:
        if "transmission" in Path(target).name and _is_new(self):
            raise OSError(errno.EIO, os.strerror(errno.EIO))
        return rename(self, target)

    monkeypatch.setattr(Path, "replace", replace)


def _is_new(path: Path) -> bool:
    return path.read_text() == "new"


@pytest.mark.parametrize("first", [None, "old"])
@pytest.mark.parametrize("second", [None, "old"])
def test_a_second_rename_that_fails_takes_the_first_one_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, first: str | None, second: str | None
) -> None:
    """Two files are one table: what was there is there again, and what was not is not."""
    paths = tmp_path / "film.exr", tmp_path / "film.transmission.exr"
    before = {path: text for path, text in zip(paths, (first, second), strict=True) if text}
    for path, text in before.items():
        path.write_text(text)
    refusing_second(monkeypatch)
    with pytest.raises(FileFormatError, match="Input/output error"):
        write_new(*paths)
    assert {path: path.read_text() for path in tmp_path.iterdir()} == before


def test_works_without_hard_links(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """FAT has none, and Linux says EPERM (link(2))."""

    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(errno.EPERM, os.strerror(errno.EPERM))

    monkeypatch.setattr(os, "link", refuse)
    test_a_second_rename_that_fails_takes_the_first_one_back(tmp_path, monkeypatch, "old", "old")


def test_a_folder_where_the_second_file_goes_is_found_first(tmp_path: Path) -> None:
    """Nothing is written at all."""
    film, folder = tmp_path / "film.exr", tmp_path / "film.transmission.exr"
    folder.mkdir()
    with pytest.raises(FileFormatError, match=r"film\.transmission\.exr cannot be written: it is a folder"):
        write_new(film, folder)
    assert list(tmp_path.iterdir()) == [folder]


def test_what_is_obsolete_goes_with_what_it_belonged_to(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It goes when the new files come, and stays when they do not."""
    film, old = tmp_path / "film.exr", tmp_path / "film.other.exr"
    film.write_text("old")
    old.write_text("old")
    with replacing(film, obsolete=[old]) as (temporary,):
        temporary.write_text("new")
        assert old.exists()
    assert list(tmp_path.iterdir()) == [film]
    old.write_text("old")
    refusing_second(monkeypatch)
    transmission = tmp_path / "film.transmission.exr"
    with pytest.raises(FileFormatError, match="Input/output error"):
        write_new(film, transmission, obsolete=[old])
    assert sorted(tmp_path.iterdir()) == [film, old]


def test_the_transmission_of_an_earlier_film_is_removed(table: Table, opaque: Table, tmp_path: Path) -> None:
    """A film on silver has none; one that some other program wrote is not touched."""
    for name in ("exr", "spectral-exr", "png"):
        path = tmp_path / f"film{FORMATS[FormatName(name)].suffix}"
        _, transmission = FORMATS[FormatName(name)].write(table, path)
        FORMATS[FormatName(name)].write(replace(opaque, variables=_without_T(opaque)), path)
        assert not transmission.exists()
        transmission.write_text("someone else's")
        FORMATS[FormatName(name)].write(replace(opaque, variables=_without_T(opaque)), path)
        assert transmission.read_text() == "someone else's"


def _without_T(table: Table) -> dict[str, Variable]:
    return {name: variable for name, variable in table.variables.items() if name != "T_rgb"}


def test_sweeps_what_killed_processes_have_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """After an hour, and only what has exactly a hidden file's name."""
    left, other = tmp_path / ".nacreous-0123456789abcdef.part", tmp_path / ".nacreous-notes.part"
    left.touch()
    other.touch()
    film = tmp_path / "film.txt"
    for age_s, kept in ((3000, [left, other]), (4000, [other])):
        now = left.stat().st_ctime + age_s
        monkeypatch.setattr("nacreous.formats.atomic.time.time", lambda now=now: now)
        with replacing(film) as (temporary,):
            temporary.write_text("new")
        assert sorted(tmp_path.iterdir()) == [*kept, film]


def test_a_folder_that_is_not_there_is_one_message(tmp_path: Path) -> None:
    """The message names the file and the reason."""
    path = tmp_path / "absent" / "film.txt"
    message = r"absent/film\.txt cannot be written: No such"
    with pytest.raises(FileFormatError, match=message), replacing(path) as (temporary,):
        temporary.write_text("new")


def test_a_name_as_long_as_can_be_is_written(tmp_path: Path) -> None:
    """255 bytes, NAME_MAX of Linux: the temporary name may not be longer than the final one."""
    path = tmp_path / f"{'n' * 251}.exr"
    with replacing(path) as (temporary,):
        temporary.write_text("new")
    assert path.exists()


_HALF_WRITTEN = """
import sys
from pathlib import Path
from nacreous.formats.atomic import replacing
with replacing(Path(sys.argv[1])) as (temporary,):
    temporary.write_bytes(b"half")
    print("half", flush=True)
    sys.stdin.read()
"""


def test_a_process_killed_in_mid_write_leaves_the_old_file(tmp_path: Path) -> None:
    """SIGKILL cannot be caught; what is left has a hidden name."""
    path = tmp_path / "film.exr"
    path.write_text("old")
    child = subprocess.Popen(
        [sys.executable, "-c", _HALF_WRITTEN, str(path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    with child:
        assert child.stdout is not None
        assert child.stdout.readline() == b"half\n"
        child.kill()
    assert path.read_text() == "old"
    (left,) = (file for file in tmp_path.iterdir() if file != path)
    assert left.name.startswith(".nacreous-")


_WRITES_FOR_EVER = """
import sys
from pathlib import Path
from nacreous.formats.registry import format_of, sampled_for
from nacreous.tables.table import Table
import xarray
path = Path(sys.argv[2])
chosen = format_of(path)
table = sampled_for(chosen, Table.from_xarray(xarray.load_dataset(sys.argv[1], engine="h5netcdf")))
while True:
    chosen.write(table, path)
    print("written", flush=True)
"""


@pytest.mark.parametrize("name", FORMATS)
def test_a_writer_killed_at_any_moment_leaves_a_complete_file(
    table: Table, rough_opaque: Table, tmp_path: Path, name: str
) -> None:
    """The file is replaced again and again; at every kill it is one that `verify` finds good."""
    source = tmp_path / "source.nc"
    of_axes = FORMATS[name].sampling is Sampling.AXES
    FORMATS["netcdf"].write(table if of_axes else rough_opaque, source)
    path = tmp_path / f"film{FORMATS[name].suffix}"
    for rounds in (1, 3):
        command = [sys.executable, "-c", _WRITES_FOR_EVER, str(source), str(path)]
        with subprocess.Popen(command, stdout=subprocess.PIPE) as child:
            assert child.stdout is not None
            for _ in range(rounds):
                assert child.stdout.readline() == b"written\n"
            child.send_signal(signal.SIGKILL)
        assert verify(path).problems == ()


_WRITES_TOO_MUCH = """
import resource, sys
from pathlib import Path
from nacreous.errors import FileFormatError
from nacreous.formats.registry import FORMATS, sampled_for
from nacreous.tables.sampling import Sampling
from nacreous.tables.table import Table
import xarray
smooth, rough = (Table.from_xarray(xarray.load_dataset(name, engine="h5netcdf")) for name in sys.argv[1:3])
tables = {
    name: smooth if chosen.sampling is Sampling.AXES else sampled_for(chosen, rough)
    for name, chosen in FORMATS.items()
}
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[4]), resource.RLIM_INFINITY))
for name, chosen in FORMATS.items():
    try:
        chosen.write(tables[name], Path(sys.argv[3], "film" + chosen.suffix))
    except FileFormatError as error:
        print(name, str(error).rpartition(": ")[2], sep="\t")
"""


@pytest.mark.parametrize("limit", [64, 1000])
def test_a_write_that_fails_leaves_nothing(
    table: Table, rough_opaque: Table, tmp_path: Path, limit: int
) -> None:
    """The kernel refuses what goes beyond RLIMIT_FSIZE with EFBIG, as a full disk does with ENOSPC."""
    sources, folder = [tmp_path / "smooth.nc", tmp_path / "rough.nc"], tmp_path / "out"
    for each, source in zip((table, rough_opaque), sources, strict=True):
        FORMATS["netcdf"].write(each, source)
    folder.mkdir()
    arguments = (*map(str, sources), str(folder), str(limit))
    command = [sys.executable, "-c", _WRITES_TOO_MUCH, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    reasons = dict(line.split("\t") for line in done.stdout.splitlines())
    assert set(reasons) == set(FORMATS)
    assert os.listdir(folder) == []  # noqa: PTH208 - hidden files as well
