"""Tables that a service computes, written as the files that this computer would write, byte for byte.

The spec is read and checked here, so that a file of specs, a preset's name and an assignment mean what they
always do; what is sent is the complete spec. All files are brought before any is put in its place.
"""

import json
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from nacreous_client import Client, Job, MissingError, Table

from nacreous.cli.progress import Observer, progress
from nacreous.cli.server import Server
from nacreous.cli.service_calls import calling
from nacreous.cli.written import Written, by_sampling, warning
from nacreous.formats import materialx
from nacreous.formats.atlas import LAYOUTS
from nacreous.formats.atomic import replacing
from nacreous.formats.companion import TRANSMISSION
from nacreous.formats.lookup import is_of
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS, Format
from nacreous.tables.identity import table_id
from nacreous.tables.spec import Spec

__all__ = ["fetched_files"]

_TEXTURES: Mapping[FormatName, FormatName] = MappingProxyType(
    {
        FormatName.EXR: FormatName.EXR,
        FormatName.SPECTRAL_EXR: FormatName.SPECTRAL_EXR,
        FormatName.PNG: FormatName.PNG,
        FormatName.MATERIALX: FormatName.EXR,
    }
)
"""Formats of pictures, and of which format these are: there is one of the transmitted part, or none."""


def fetched_files(server: Server, spec: Spec, formats: Sequence[Format], stem: Path) -> Iterator[Written]:
    """Have a spec computed, bring its files, and yield each once it is there; raises `NacreousError`."""
    with tempfile.TemporaryDirectory(prefix="nacreous-") as folder:
        here = Path(folder, stem.name)
        files = _brought(server, spec, formats, here)
        stem.parent.mkdir(parents=True, exist_ok=True)
        for alike in by_sampling(formats):
            yield from _placed(spec, alike, files, stem)


def _brought(
    server: Server, spec: Spec, formats: Sequence[Format], here: Path
) -> dict[FormatName, tuple[Path, ...]]:
    """Return the files of each format, complete, in a folder of their own."""
    with calling(server) as client:
        with progress("tabulating") as observer:
            table = client.tabulate(spec.model_dump(mode="json"), _of_job(observer))
        _note_other_version(table, spec)
        return {chosen.name: _files_of(client, table, chosen, here) for chosen in formats}


def _note_other_version(table: Table, spec: Spec) -> None:
    if table.id != table_id(spec):
        note = (
            "the service has another version of Nacreous: the table that it makes of this spec has another id"
        )
        print(f"nacreous: {note}", file=sys.stderr)


def _files_of(client: Client, table: Table, chosen: Format, here: Path) -> tuple[Path, ...]:
    """Bring the file of a format, and those that belong to it; each once, whichever format it is of."""
    found = [_brought_file(client, table, chosen.suffix, here)]
    if texture := _TEXTURES.get(chosen.name):
        suffix = FORMATS[texture].suffix
        wanted = [] if texture is chosen.name else [suffix]
        found += [_brought_file(client, table, each, here) for each in (*wanted, f"{TRANSMISSION}{suffix}")]
    files = tuple(path for path in found if path is not None)
    if chosen.name is FormatName.MATERIALX:
        materialx.rename_textures(files[0], files[1:])
    return files


def _brought_file(client: Client, table: Table, suffix: str, here: Path) -> Path | None:
    """Bring a file, if the table has it: without the transmitted part there is no picture of it."""
    path = here.with_name(f"{here.name}{suffix}")
    if path.exists():
        return path
    with progress("downloading") as observer:
        try:
            client.download(table.id, suffix, path, _of_bytes(observer), _of_job(observer))
        except MissingError:
            if not suffix.startswith(TRANSMISSION):
                raise
            return None
    return path


def _placed(
    spec: Spec, formats: Sequence[Format], files: Mapping[FormatName, tuple[Path, ...]], stem: Path
) -> Iterator[Written]:
    """Put the files of one table in their places, and yield each once; the files say what is known of it."""
    told: set[Path] = set()
    for chosen in formats:
        known = chosen.read(files[chosen.name][0]).provenance
        certificate = json.loads(known["certificate"])
        if chosen is formats[0] and (fault := warning(formats, certificate)):
            print(fault, file=sys.stderr)
        paths = _put(spec, chosen, files[chosen.name], stem)
        yield from (Written(path, chosen, known["id"], certificate) for path in paths if path not in told)
        told.update(paths)


def _put(spec: Spec, chosen: Format, sources: Sequence[Path], stem: Path) -> tuple[Path, ...]:
    """Put the files of one format beside one another, all or none."""
    paths = tuple(stem.with_name(source.name) for source in sources)
    with replacing(*paths, obsolete=_obsolete(spec, chosen, paths, stem)) as temporaries:
        for source, temporary in zip(sources, temporaries, strict=True):
            shutil.copyfile(source, temporary)
    return paths


def _obsolete(spec: Spec, chosen: Format, paths: Sequence[Path], stem: Path) -> tuple[Path, ...]:
    """Return what an earlier table has left where this one has nothing: see `lookup_files`."""
    if chosen.name not in _TEXTURES:
        return ()
    texture = FORMATS[_TEXTURES[chosen.name]]
    companion = stem.with_name(f"{stem.name}{TRANSMISSION}{texture.suffix}")
    _, transmitted = LAYOUTS[spec.table.quantity].names
    return (companion,) if companion not in paths and is_of(transmitted, companion, texture.read) else ()


def _of_job(observer: Observer | None) -> Callable[[Job], None] | None:
    return None if observer is None else lambda job: observer(job.fraction)


def _of_bytes(observer: Observer | None) -> Callable[[int, int | None], None] | None:
    return None if observer is None else lambda come, total: observer(come / total if total else 0.0)
