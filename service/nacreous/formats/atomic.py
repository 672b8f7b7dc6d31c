"""Files that are there completely, or not at all.

A file is written under a hidden name in the folder it is for, brought to the disk, and renamed: `rename`
swaps names in one step (POSIX.1-2017, rename). Where several files belong together, each old one keeps a
second name until all new ones are in place, so that a failure can bring every one of them back. What fails or
is interrupted leaves the old files as they were; a killed process leaves at most a hidden
``.nacreous-….part``, which a later write to the folder removes.
"""

import os
import re
import secrets
import shutil
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from nacreous.errors import FileFormatError, reason

__all__ = ["replacing"]

_HIDDEN = re.compile(r"\.nacreous-[0-9a-f]{16}\.part")
_ABANDONED_S = 3600.0
"""Age beyond which a hidden file belongs to nobody: a writer changes its own all the time."""


@contextmanager
def replacing(*paths: Path, obsolete: Sequence[Path] = ()) -> Iterator[tuple[Path, ...]]:
    """Yield one path to write for each of `paths`, and put all files in place once all are written.

    Files at `obsolete` belong to what is replaced, and are removed with it.

    Raises
    ------
    FileFormatError
        A file cannot be written; none of `paths` and `obsolete` has changed.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     film = Path(folder, "film.txt")
    ...     with replacing(film) as (temporary,):
    ...         _ = temporary.write_text("new")
    ...     film.read_text()
    'new'
    """
    temporaries = tuple(_hidden_beside(path) for path in paths)
    try:
        _check_targets(paths)
        for folder in {path.parent for path in paths}:
            _sweep(folder)
        yield temporaries
        for temporary in temporaries:
            _bring_to_disk(temporary)
        _swap(temporaries, paths, obsolete)
        for folder in {path.parent for path in paths}:
            _bring_to_disk(folder)
    except OSError as error:
        names = " and ".join(map(str, paths))
        raise FileFormatError(f"{names} cannot be written: {reason(error)}") from error
    finally:
        for temporary in temporaries:
            temporary.unlink(missing_ok=True)


def _hidden_beside(path: Path) -> Path:
    """Return a new hidden name, not made from the final one, which may be as long as a name can be."""
    return path.with_name(f".nacreous-{secrets.token_hex(8)}.part")


def _check_targets(paths: Sequence[Path]) -> None:
    for path in paths:
        if path.is_dir():
            raise FileFormatError(f"{path} cannot be written: it is a folder")


def _swap(temporaries: Sequence[Path], paths: Sequence[Path], obsolete: Sequence[Path]) -> None:
    """Rename all files, or none."""
    with ExitStack() as undo:
        kept = [_keep(path, undo) for path in (*paths, *obsolete)]
        for temporary, path in zip(temporaries, paths, strict=True):
            temporary.replace(path)
        for path in obsolete:
            path.unlink()
        undo.pop_all()
    for backup in kept:
        backup.unlink(missing_ok=True)


def _keep(path: Path, undo: ExitStack) -> Path:
    """Give an old file a second name, from which `undo` brings it back; where there is none, it removes."""
    backup = _hidden_beside(path)
    if not os.path.lexists(path):
        undo.callback(path.unlink, missing_ok=True)
        return backup
    undo.callback(backup.unlink, missing_ok=True)  # two names of one file: rename leaves both
    try:
        os.link(path, backup, follow_symlinks=False)
    except OSError:  # a file system without hard links
        shutil.copy2(path, backup, follow_symlinks=False)
    undo.callback(backup.replace, path)
    return backup


def _sweep(folder: Path) -> None:
    """Remove what killed processes have left; what cannot be removed stays."""
    oldest = time.time() - _ABANDONED_S
    with suppress(OSError):
        for path in folder.iterdir():
            # The time of the inode: a second name has the old file's time of writing.
            if _HIDDEN.fullmatch(path.name) and path.lstat().st_ctime < oldest:
                path.unlink(missing_ok=True)


def _bring_to_disk(path: Path) -> None:
    """Wait until a file, or the names in a folder, would outlive a power failure."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
