"""Specs that come with Nacreous, each with the source of its numbers."""

from collections.abc import Iterable
from pathlib import Path

from nacreous.errors import SpecError
from nacreous.optics.value import did_you_mean, shown
from nacreous.tables.spec import Spec

__all__ = ["load", "preset", "preset_names", "preset_text"]

_SUFFIXES = (".toml", ".json")


_FOLDER = Path(__file__).parents[1] / "optics" / "presets"


def preset_names() -> tuple[str, ...]:
    """Return the names of all presets, such as ``"soap-bubble"`` and ``"paper/figure-3"``, in order."""
    files = _FOLDER.rglob("*.toml")
    return tuple(sorted(file.relative_to(_FOLDER).with_suffix("").as_posix() for file in files))


def preset(name: str, overrides: Iterable[str] = ()) -> Spec:
    """Return a preset, with assignments such as ``"table.cos_theta=256"`` carried out.

    Raises
    ------
    SpecError
        There is no preset of this name; the message has the closest ones.
    """
    if name not in preset_names():
        remedy = did_you_mean(name, preset_names(), otherwise="`nacreous presets` lists them")
        raise SpecError("", "the name of a preset", shown(name), remedy)
    return Spec.from_file(_FOLDER / f"{name}.toml", overrides)


def preset_text(name: str) -> str:
    """Return a preset as it was written, comments and all; raises `SpecError` where there is none."""
    preset(name)
    return (_FOLDER / f"{name}.toml").read_text(encoding="utf-8").rstrip()


def load(spec_or_preset: str | Path, overrides: Iterable[str] = ()) -> Spec:
    """Return the spec in a file, or the preset of this name; raises `SpecError`.

    A name that ends in ``.toml`` or ``.json``, or begins with a folder, is a file. Any other is a preset or,
    where there is none, a file.
    """
    name = str(spec_or_preset)
    if isinstance(spec_or_preset, Path) or name.lower().endswith(_SUFFIXES):
        return Spec.from_file(spec_or_preset, overrides)
    if name not in preset_names() and (_is_file(name) or _is_path(name)):
        return Spec.from_file(name, overrides)
    return preset(name, overrides)


def _is_path(name: str) -> bool:
    """Tell whether a name leads through folders, which are none of those of the presets."""
    first, slash, _ = name.partition("/")
    return bool(slash) and not any(known.startswith(f"{first}/") for known in preset_names())


def _is_file(name: str) -> bool:
    try:
        return Path(name).is_file()
    except (OSError, ValueError):  # too long, or with a NUL character
        return False
