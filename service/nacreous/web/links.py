"""Where a table, a preset and a job are found; every link is written here alone."""

from collections.abc import Iterator
from functools import lru_cache
from urllib.parse import quote

from nacreous.engine.jobs import Job
from nacreous.errors import SpecError
from nacreous.formats.companion import ACCOMPANIED, TRANSMISSION
from nacreous.formats.registry import FORMATS, Format, check_holds
from nacreous.optics.stack import sample_stack
from nacreous.tables.axes import wavelength_values_nm
from nacreous.tables.solver import TRANSMITTING_K
from nacreous.tables.spec import Spec

__all__ = ["holding_formats", "job_links", "preset_links", "table_links"]


def holding_formats(spec: Spec) -> Iterator[Format]:
    """Yield the formats that can hold the table of a spec."""
    for entry in FORMATS.values():
        try:
            check_holds(entry, spec)
        except SpecError:
            continue
        yield entry


@lru_cache(maxsize=1024)
def _files(spec: Spec) -> tuple[tuple[str, str], ...]:
    files = [(entry.name.value, entry.suffix) for entry in holding_formats(spec)]
    if _transmits(spec):
        files += [(f"{name}-transmission", TRANSMISSION + end) for name, end in files if name in ACCOMPANIED]
    return tuple(files)


def _transmits(spec: Spec) -> bool:
    """Tell whether pictures of a film have a companion for what it transmits."""
    if spec.table.quantity != "fresnel":
        return False
    index = sample_stack(spec.stack, wavelength_values_nm(spec.table.wavelength_nm)).index
    return bool(index[-1].imag.max() < TRANSMITTING_K)


def table_links(table_id: str, spec: Spec) -> dict[str, str]:
    """Return the links of a table: itself, and a file a format."""
    return _links(f"/v1/tables/{table_id}", spec)


def preset_links(name: str, spec: Spec) -> dict[str, str]:
    """Return the links of a preset: itself, and a file a format."""
    return _links(f"/v1/presets/{quote(name)}", spec)


def _links(stem: str, spec: Spec) -> dict[str, str]:
    return {"self": stem, **{name: f"{stem}{suffix}" for name, suffix in _files(spec)}}


def job_links(job: Job) -> dict[str, str]:
    """Return the links of a job: itself, and its progress."""
    return {"self": f"/v1/jobs/{job.id}", "events": f"/v1/jobs/{job.id}/events"}
