"""Where a command writes: checked before anything is computed, made when there is something to write."""

import os
from pathlib import Path

from nacreous.errors import SpecError, reason
from nacreous.optics.value import shown

__all__ = ["check_folder", "check_suffix", "file_stem"]


def check_folder(folder: Path) -> None:
    """Refuse a folder in which no file could be written; raises `SpecError`."""
    try:
        existing = next(parent for parent in (folder, *folder.absolute().parents) if parent.exists())
        usable = existing.is_dir() and os.access(existing, os.W_OK | os.X_OK)
    except (OSError, ValueError) as error:  # too long a name, or one with a NUL character
        raise SpecError("--output", "a folder that can be written", reason(error)) from None
    if not usable:
        what = "cannot be written" if existing.is_dir() else "is a file"
        raise SpecError("--output", "a folder that can be written", f"{shown(str(existing))}, which {what}")


def check_suffix(picture: Path) -> None:
    """Refuse a name under which nobody would look for a PNG; raises `SpecError`."""
    if picture.suffix.lower() != ".png":
        raise SpecError("--output", "a file name that ends in .png", shown(picture.name))


def file_stem(spec_or_preset: str) -> str:
    """Return the name, without a suffix, of a spec's files.

    >>> file_stem("paper/figure-3"), file_stem("specs/film.toml")
    ('paper-figure-3', 'film')
    """
    from nacreous.tables.presets import preset_names

    if spec_or_preset in preset_names():
        return spec_or_preset.replace("/", "-")
    return Path(spec_or_preset).stem
