"""What has been put outlives a power failure: the order of system calls, seen from outside (strace)."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

PUT = """
import sys
from nacreous.store.entry import Entry
from nacreous.store.store import open_store
open_store(sys.argv[1]).put("tables/ab/film", Entry({}, b"a texture"))
"""

CALLS = "fsync,fdatasync,mkdirat,rename,renameat,renameat2"


@pytest.fixture
def calls(tmp_path: Path) -> list[str]:
    """Return the calls of one put that concern the store, a line each, with the files that they name."""
    tracer = shutil.which("strace")
    if tracer is None:
        pytest.skip("the package strace is not installed")
    log, store = tmp_path / "calls", tmp_path / "store"
    program = [sys.executable, "-c", PUT, str(store)]
    options = ["-y", "-qq", "-f", "--seccomp-bpf", "-e", f"trace={CALLS}", "-o", str(log)]
    done = subprocess.run([tracer, *options, *program], capture_output=True, text=True)
    if done.returncode:
        pytest.skip(f"strace may not trace here: {done.stderr.strip()}")
    return [line for line in log.read_text().splitlines() if str(store) in line]


def test_brings_everything_to_the_disk_in_order(calls: list[str]) -> None:
    """A name must not reach the disk before its bytes do, and a name is in its folder (fsync(2), notes)."""
    [made] = [at for at, call in enumerate(calls) if "mkdirat" in call and '"ab"' in call]
    assert "fsync" in calls[made + 1]
    assert "store/tables>" in calls[made + 1]
    [renamed] = [at for at, call in enumerate(calls) if "rename" in call]
    assert "fsync" in calls[renamed - 1]
    assert ".part>" in calls[renamed - 1]
    assert "fsync" in calls[renamed + 1]
    assert "store/tables/ab>" in calls[renamed + 1]
