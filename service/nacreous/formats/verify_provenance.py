"""Whether what a file says about itself agrees with its spec."""

import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.formats.atlas import LAYOUTS, atlas_of
from nacreous.formats.contents import Contents
from nacreous.formats.lookup import colour_facts
from nacreous.formats.spec_axes import spec_axes
from nacreous.opencl.sources import kernels_hash
from nacreous.optics.value import shown
from nacreous.tables.certificate import certificate_fields
from nacreous.tables.identity import table_id
from nacreous.tables.sampling import Sampling
from nacreous.tables.spec import Spec
from nacreous.tables.spec_document import Syntax

__all__ = ["check_provenance", "foreign_kernels"]

_PROMISED = ("id", "version", "spec", "certificate", "precision", "device", "kernels", "checksum")
_SHA256 = re.compile(r"[0-9a-f]{64}")
_NM = 1e-6
"""To how many nm the name of a channel says its wavelength."""


def foreign_kernels(contents: Contents) -> bool:
    """Tell whether other kernels than these have computed the file: its id cannot be checked then."""
    return contents.provenance.get("kernels") != kernels_hash()


def check_provenance(contents: Contents) -> Iterator[str]:
    """Yield what is missing, does not hold, or contradicts the spec."""
    yield from _check_promised(contents, _PROMISED)
    yield from _check_certificate(contents)
    try:
        spec = Spec.from_text(contents.provenance.get("spec", ""), Syntax.JSON)
        found = [problem for check in _AGREEMENTS for problem in check(contents, spec)]
    except SpecError as error:
        yield f"nacreous:spec: {error}"
    else:
        yield from found


def _check_promised(contents: Contents, promised: Iterable[str]) -> Iterator[str]:
    missing = [key for key in promised if key not in contents.provenance]
    if missing:
        yield f"expected the attributes {', '.join(f'nacreous:{key}' for key in missing)}, got none"


def _check_certificate(contents: Contents) -> Iterator[str]:
    certificate = _parsed(contents.provenance.get("certificate", ""))
    if not isinstance(certificate, dict) or not all(
        value is None or isinstance(value, int | float) for value in certificate.values()
    ):
        yield f"nacreous:certificate: expected an object of numbers, got {shown(certificate)}"


def _parsed(text: str) -> object:
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        return text


# ---- agreement with the spec -------------------------------------------------------------------------------


def _check_figures(contents: Contents, spec: Spec) -> Iterator[str]:
    """Require the figures that this version knows, of a file that it has written; others may have others."""
    certificate = _parsed(contents.provenance.get("certificate", ""))
    if not isinstance(certificate, dict) or foreign_kernels(contents):
        return
    absent = [
        name for name in certificate_fields(spec.table.quantity, contents.sampling) if name not in certificate
    ]
    if absent:
        yield f"nacreous:certificate: expected the figures {', '.join(absent)}, got none"


def _check_id(contents: Contents, spec: Spec) -> Iterator[str]:
    """Compare the id with the spec's, where the kernels that made the file are these kernels."""
    claimed = contents.provenance.get("id", "")
    if not _SHA256.fullmatch(claimed):
        yield f"nacreous:id: expected 64 hexadecimal digits, got {shown(claimed)}"
    elif not foreign_kernels(contents) and claimed != table_id(spec):
        yield f"nacreous:id: expected {table_id(spec)}, the id of the file's spec, got {claimed}"


def _check_colour(contents: Contents, spec: Spec) -> Iterator[str]:
    for key, expected in colour_facts(spec.colour).items():
        got = contents.provenance.get(key, expected)
        if got != expected:
            yield f"nacreous:{key}: expected {expected}, as the spec says, got {shown(got)}"


def _check_arrays(contents: Contents, spec: Spec) -> Iterator[str]:
    """Compare axes that are arrays with the spec's; those of a measured material are its readers'."""
    if contents.sampling is not Sampling.AXES:
        return
    refined = spec.accuracy.delta_e is not None
    axes = spec_axes(spec)
    for name in axes.keys() & contents.arrays.keys():
        if not _is_axis(np.unique(contents.arrays[name]), axes[name].samples, refined=refined):
            yield f"{name}: expected the axis of the spec, got another"


def _is_axis(got: NDArray[np.float64], expected: NDArray[np.float64], *, refined: bool) -> bool:
    """Tell whether an axis is the spec's, or one that refinement has made of it: its ends stay."""
    if refined:
        return len(got) >= len(expected) and np.allclose(got[[0, -1]], expected[[0, -1]], rtol=0, atol=_NM)
    return len(got) == len(expected) and np.allclose(got, expected, rtol=0, atol=_NM)


def _check_picture(contents: Contents, spec: Spec) -> Iterator[str]:
    """Compare what a picture says of itself with what its spec makes of it.

    Arrays have axes of their own, and a model that was fitted to the table has none.
    """
    layout = LAYOUTS[spec.table.quantity]
    modelled = "model" in contents.provenance or contents.sampling is not Sampling.AXES
    if layout.x in contents.arrays or modelled:
        return
    wanted = atlas_of(spec.table.quantity, spec_axes(spec)).described()
    yield from _check_promised(contents, ("quantity", *wanted, *colour_facts(spec.colour)))
    name = contents.provenance.get("quantity", layout.names[0])
    if name not in layout.names:
        yield f"nacreous:quantity: expected {' or '.join(layout.names)}, as the spec says, got {shown(name)}"
    refined = spec.accuracy.delta_e is not None
    for key in wanted.keys() & contents.provenance.keys():
        got = contents.provenance[key]
        if not _is_described(_parsed(got), wanted[key], refined=refined):
            yield f"nacreous:{key}: expected {_names(wanted[key])} as the spec has it, got {shown(got)}"


def _is_described(got: object, wanted: Mapping[str, Any], *, refined: bool) -> bool:
    """Tell whether an attribute says what the spec does; of refined axes, all that refinement leaves."""
    if not isinstance(got, dict):
        return False
    if refined:
        return _outline(got) == _outline(wanted)
    return all(got.get(key) == wanted.get(key) for key in (*wanted, "values"))


def _outline(described: Mapping[str, Any]) -> object:
    """Return names, units and ends of the axes; None where there is no telling."""
    try:
        axes = described.get("axes", [described])
        return [(axis["name"], axis["unit"], axis.get("range") or _ends(axis["values"])) for axis in axes]
    except (KeyError, TypeError, IndexError, AttributeError):
        return None


def _ends(values: list[float]) -> list[float]:
    return [values[0], values[-1]]


def _names(described: Mapping[str, Any]) -> str:
    return ", ".join(str(axis["name"]) for axis in described.get("axes", [described]))


_AGREEMENTS: tuple[Callable[[Contents, Spec], Iterator[str]], ...] = (
    _check_figures,
    _check_id,
    _check_colour,
    _check_arrays,
    _check_picture,
)
