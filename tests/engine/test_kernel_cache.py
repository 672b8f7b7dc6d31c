"""Folders of kernels: one user each, kept between starts, and elsewhere where they cannot be."""

import subprocess
import sys
from pathlib import Path

import pytest

from nacreous.engine.kernel_cache import take_cache, take_temporary_cache
from nacreous.errors import DeviceError

HOLDER = """
import pathlib, sys
from nacreous.engine.kernel_cache import take_cache
print(take_cache(pathlib.Path(sys.argv[1])).folder, flush=True)
sys.stdin.read()
"""


def test_each_user_has_a_folder_alone_and_finds_it_again(tmp_path: Path) -> None:
    """Two at once have different folders; what the first has kept, the next finds."""
    first, second = take_cache(tmp_path), take_cache(tmp_path)
    assert first.folder != second.folder
    (first.folder / "kernel").write_text("compiled")
    first.release()
    again = take_cache(tmp_path)
    assert (again.folder / "kernel").read_text() == "compiled"
    again.release()
    second.release()


def test_the_folder_of_a_killed_process_is_free_again(tmp_path: Path) -> None:
    """The lock ends with its holder, however that ends: no stale lock is left."""
    command = [sys.executable, "-c", HOLDER, str(tmp_path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as holder:
        assert holder.stdout is not None
        held = Path(holder.stdout.readline().strip())
        mine = take_cache(tmp_path)
        assert mine.folder != held
        holder.kill()
    cache = take_cache(tmp_path)
    assert cache.folder == held
    cache.release()
    mine.release()


def test_what_a_killed_compiler_has_left_is_removed(tmp_path: Path) -> None:
    """Temporary files do not gather; kernels stay, until they are wiped."""
    cache = take_cache(tmp_path)
    (cache.folder / "tempfile_ab12").write_text("half a kernel")
    (cache.folder / "AB").mkdir()
    (cache.folder / "AB" / "kernel.so").write_text("compiled")
    cache.release()
    cache = take_cache(tmp_path)
    assert [path.name for path in cache.folder.iterdir()] == ["AB"]
    cache.wipe()
    assert list(cache.folder.iterdir()) == []
    assert cache.usable
    cache.release()


def test_a_temporary_folder_is_gone_afterwards() -> None:
    """What is temporary belongs to nobody else, and is removed with all that is in it."""
    cache = take_temporary_cache()
    (cache.folder / "kernel").write_text("compiled")
    assert cache.folder.stat().st_mode & 0o077 == 0
    cache.release()
    assert not cache.folder.exists()


def test_where_nothing_can_be_written_the_folders_are_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The message says where it was tried and why it failed."""
    (tmp_path / "file").write_text("no folder")
    monkeypatch.setattr("nacreous.engine.kernel_cache._TEMPORARY", (str(tmp_path / "file"),))
    with pytest.raises(DeviceError, match=r"file.*Not a directory.*make one of them writable"):
        take_cache(tmp_path / "file")
