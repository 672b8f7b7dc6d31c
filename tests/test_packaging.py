"""The package as it is installed: a wheel, and an archive of the sources that builds the same wheel."""

import os
import runpy
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

from built_page import built_page

ROOT = Path(__file__).parents[1]

NOT_PYTHON = {
    "nacreous/kernels": "kernels/*.cl*",
    "nacreous/clients": "clients/*.md",
    "nacreous/optics": "service/nacreous/optics/*.csv",
    "nacreous/optics/presets": "service/nacreous/optics/presets/*.toml",
    "nacreous/optics/presets/paper": "service/nacreous/optics/presets/paper/*.toml",
    "nacreous/opencl": "service/nacreous/opencl/*.json",
    "nacreous": "service/nacreous/py.typed",
    "nacreous_client": "clients/python/nacreous_client/*",
}
"""Folder in the wheel -> files of the checkout that it must hold."""


def build(source: Path, target: str, folder: Path) -> Path:
    """Build a wheel or an sdist with the installed hatchling; the page is built once, for all of them."""
    built_page()
    command = [sys.executable, "-m", "hatchling", "build", "-t", target, "-d", str(folder)]
    done = subprocess.run(command, cwd=source, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    (built,) = folder.iterdir()
    return built


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the wheel of this checkout."""
    return build(ROOT, "wheel", tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module")
def sdist(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the archive of this checkout's sources."""
    return build(ROOT, "sdist", tmp_path_factory.mktemp("sdist"))


def names(wheel: Path) -> set[str]:
    """Return the names of all files in a wheel."""
    with zipfile.ZipFile(wheel) as archive:
        return set(archive.namelist())


@pytest.mark.parametrize("folder", NOT_PYTHON)
def test_the_wheel_holds_what_is_not_python(folder: str, wheel: Path) -> None:
    """Kernels, client files and data are in the wheel, where the package looks for them; so is the client."""
    expected = {f"{folder}/{file.name}" for file in ROOT.glob(NOT_PYTHON[folder]) if file.is_file()}
    assert expected
    assert expected <= names(wheel)


def test_the_wheel_holds_the_packages_alone(wheel: Path) -> None:
    """Neither tests nor documentation nor leftovers are installed, and the client once."""
    tops = {name.partition("/")[0] for name in names(wheel)}
    assert {top for top in tops if not top.endswith(".dist-info")} == {"nacreous", "nacreous_client"}
    assert not [name for name in names(wheel) if name.startswith("nacreous/clients/python/nacreous_client")]
    assert not [name for name in names(wheel) if "__pycache__" in name]


def test_the_wheel_holds_the_page(wheel: Path) -> None:
    """Every file that was built, each text compressed as well, and nothing that it was built with."""
    page = built_page()
    built = {f"nacreous/web/page/{file.relative_to(page)}" for file in page.rglob("*") if file.is_file()}
    assert {"nacreous/web/page/index.html", "nacreous/web/page/index.html.gz"} <= built
    assert {name for name in names(wheel) if name.startswith("nacreous/web/page/")} == built
    assert not [name for name in names(wheel) if "node_modules" in name]


def unpack(archive: tarfile.TarFile, folder: Path) -> None:
    """Unpack an archive of ours; Python before 3.11.4 has no filters, and 3.14 has none but by default."""
    filters = {"filter": "data"} if hasattr(tarfile, "data_filter") else {}
    archive.extractall(folder, **filters)  # noqa: S202 - it has just been made here


def test_the_sources_hold_what_the_page_is_built_from(sdist: Path, tmp_path: Path) -> None:
    """They have the page, and the very sources that it was built from, by their digest."""
    with tarfile.open(sdist) as archive:
        unpack(archive, tmp_path)
    (source,) = tmp_path.iterdir()
    assert not list(source.rglob("node_modules"))
    built = source / "service" / "nacreous" / "web" / "page" / "built-from.txt"
    program = runpy.run_path(str(source / "service" / "page" / "build.py"))
    assert program["digest_of_sources"]() == built.read_text()


def test_the_sources_build_the_same_wheel(wheel: Path, sdist: Path, tmp_path: Path) -> None:
    """An sdist is complete: the wheel built from it holds the same files."""
    with tarfile.open(sdist) as archive:
        unpack(archive, tmp_path / "source")
    (source,) = (tmp_path / "source").iterdir()
    assert names(build(source, "wheel", tmp_path / "wheel")) == names(wheel)


def test_the_sources_leave_out_what_a_machine_made(sdist: Path) -> None:
    """No environment, cache or output is in the archive."""
    with tarfile.open(sdist) as archive:
        tops = {Path(name).parts[1] for name in archive.getnames() if len(Path(name).parts) > 1}
    assert not {top for top in tops if top.startswith(".venv") or top.endswith("_cache") or top == "out"}
    assert {"LICENSE", "README.md", "pyproject.toml", "kernels", "service", "tests"} <= tops


def test_an_installed_wheel_computes_outside_of_the_checkout(wheel: Path, tmp_path: Path) -> None:
    """The installed program needs no checkout: it finds its kernels and presets beside itself."""
    installed, elsewhere = tmp_path / "installed", tmp_path / "elsewhere"
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--target"]
    subprocess.run([*pip, str(installed), str(wheel)], check=True)
    elsewhere.mkdir()
    program = (
        "import sys, nacreous, nacreous.paths; from nacreous.cli.app import main;"
        "print(nacreous.__file__, nacreous.paths.KERNELS, flush=True);"
        "sys.argv[1:] = ['tabulate', 'paper/figure-3', '--set', 'table.cos_theta=8']; main()"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        cwd=elsewhere,
        env={**os.environ, "PYTHONPATH": str(installed)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    package = installed / "nacreous"
    assert done.stdout.splitlines()[0] == f"{package / '__init__.py'} {package / 'kernels'}"
    assert (elsewhere / "paper-figure-3.exr").exists()
