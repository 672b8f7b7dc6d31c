"""Whether what a file says about itself agrees with its spec."""

import json
import re
from collections.abc import Iterator
from dataclasses import fields

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.formats.contents import Contents
from nacreous.formats.lookup import axis_attribute, colour_facts
from nacreous.opencl.sources import kernels_hash
from nacreous.optics.value import shown
from nacreous.tables.axes import cos_theta_values, thickness_scale_values, wavelength_values_nm
from nacreous.tables.certificate import Certificate
from nacreous.tables.identity import table_id
from nacreous.tables.spec import Spec
from nacreous.tables.spec_document import Syntax

__all__ = ["AXES", "check_provenance", "foreign_kernels"]

AXES = ("thickness_scale", "cos_theta", "wavelength_nm", "channel")
"""Arrays of a file that are no quantities."""

_PROMISED = ("id", "version", "spec", "certificate", "precision", "device", "kernels", "checksum")
_OF_PICTURES = ("quantity", "axis.x", "axis.y", "colour.space", "colour.illuminant", "colour.observer")
_SHA256 = re.compile(r"[0-9a-f]{64}")
_NM = 1e-6
"""To how many nm the name of a channel says its wavelength."""


def foreign_kernels(contents: Contents) -> bool:
    """Tell whether other kernels than these have computed the file: its id cannot be checked then."""
    return contents.provenance.get("kernels") != kernels_hash()


def check_provenance(contents: Contents) -> Iterator[str]:
    """Yield what is missing, does not hold, or contradicts the spec."""
    promised = _PROMISED if "cos_theta" in contents.arrays else (*_PROMISED, *_OF_PICTURES)
    missing = [key for key in promised if key not in contents.provenance]
    if missing:
        yield f"expected the attributes {', '.join(f'nacreous:{key}' for key in missing)}, got none"
    yield from _check_certificate(contents)
    try:
        spec = Spec.from_text(contents.provenance.get("spec", ""), Syntax.JSON)
        agree = [*_check_id(contents, spec), *_check_colour(contents, spec), *_check_axes(contents, spec)]
    except SpecError as error:
        yield f"nacreous:spec: {error}"
    else:
        yield from agree


def _check_certificate(contents: Contents) -> Iterator[str]:
    """Require the figures that this version knows, of a file that it has written; others may have others."""
    certificate = _parsed(contents.provenance.get("certificate", ""))
    if not isinstance(certificate, dict) or not all(
        value is None or isinstance(value, int | float) for value in certificate.values()
    ):
        yield f"nacreous:certificate: expected an object of numbers, got {shown(certificate)}"
        return
    absent = [field.name for field in fields(Certificate) if field.name not in certificate]
    if absent and not foreign_kernels(contents):
        yield f"nacreous:certificate: expected the figures {', '.join(absent)}, got none"


def _parsed(text: str) -> object:
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        return text


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


def _check_axes(contents: Contents, spec: Spec) -> Iterator[str]:
    """Compare axes with the spec's, whether they are arrays or the attributes of a picture."""
    axes = spec.table
    expected = {
        "thickness_scale": thickness_scale_values(axes.thickness_scale),
        "cos_theta": cos_theta_values(axes.cos_theta),
        "wavelength_nm": wavelength_values_nm(axes.wavelength_nm),
    }
    refined = spec.accuracy.delta_e is not None
    for name in expected.keys() & contents.arrays.keys():
        if not _is_axis(np.unique(contents.arrays[name]), expected[name], refined=refined):
            yield f"{name}: expected the axis of the spec, got another"
    for key, name in (("axis.x", "cos_theta"), ("axis.y", "thickness_scale")):
        got = _parsed(contents.provenance.get(key, "null"))
        wanted = json.loads(axis_attribute(name, expected[name]))
        if key in contents.provenance and not _is_described(got, wanted, refined=refined):
            yield f"nacreous:{key}: expected {name} as the spec has it, got {shown(contents.provenance[key])}"


def _is_axis(got: NDArray[np.float64], expected: NDArray[np.float64], *, refined: bool) -> bool:
    """Tell whether an axis is the spec's, or one that refinement has made of it: its ends stay."""
    if refined:
        return len(got) >= len(expected) and np.allclose(got[[0, -1]], expected[[0, -1]], rtol=0, atol=_NM)
    return len(got) == len(expected) and np.allclose(got, expected, rtol=0, atol=_NM)


def _is_described(got: object, wanted: dict[str, object], *, refined: bool) -> bool:
    """Tell whether an attribute says what the spec does; of a refined axis, all that refinement leaves."""
    if not isinstance(got, dict):
        return False
    compared = ("name", "unit", "range") if refined else (*wanted, "values")
    return all(got.get(key) == wanted.get(key) for key in compared)
