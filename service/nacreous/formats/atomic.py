"""Files that are there completely, or not at all.

A file is written under a hidden name in the folder it is for, brought to the disk, and renamed: `rename`
swaps names in one step (POSIX.1-2017, rename). What fails or is interrupted leaves the old file as it was; a
killed process leaves at most a hidden ``.nacreous-….part``.
"""

import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from nacreous.errors import FileFormatError

__all__ = ["replacing"]


@contextmanager
def replacing(*paths: Path) -> Iterator[tuple[Path, ...]]:
    """Yield one path to write for each of `paths`, and put all files in place once all are written.

    Raises
    ------
    FileFormatError
        A file cannot be written; none of `paths` has changed.

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
    # Not made from the final name, which may be as long as a name can be.
    temporaries = tuple(path.with_name(f".nacreous-{secrets.token_hex(8)}.part") for path in paths)
    try:
        yield temporaries
        for temporary in temporaries:
            _bring_to_disk(temporary)
        for temporary, path in zip(temporaries, paths, strict=True):
            temporary.replace(path)
        for folder in {path.parent for path in paths}:
            _bring_to_disk(folder)
    except OSError as error:
        names = " and ".join(map(str, paths))
        raise FileFormatError(f"{names} cannot be written: {error.strerror or error}") from error
    finally:
        for temporary in temporaries:
            temporary.unlink(missing_ok=True)


def _bring_to_disk(path: Path) -> None:
    """Wait until a file, or the names in a folder, would outlive a power failure."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
