"""The client as a package of its own."""

import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

Call = Callable[..., Any]

ROOT = Path(__file__).parents[3]


def test_it_imports_nothing_of_nacreous() -> None:
    """Its users need no OpenCL and no NumPy."""
    script = "import sys, nacreous_client; print(*{name.partition('.')[0] for name in sys.modules})"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert {"nacreous", "numpy", "pydantic"}.isdisjoint(done.stdout.split())


def test_it_installs_alone(tmp_path: Path) -> None:
    """A wheel of its own holds the package and the mark of its types (PEP 561)."""
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(tmp_path)]
    done = subprocess.run(build, cwd=ROOT / "clients" / "python", capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    (wheel,) = tmp_path.iterdir()
    names = {name for name in zipfile.ZipFile(wheel).namelist() if not name.split("/")[0].endswith("-info")}
    package = ROOT / "clients" / "python" / "nacreous_client"
    assert names == {f"nacreous_client/{file.name}" for file in package.iterdir() if file.is_file()}
