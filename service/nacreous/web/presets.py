"""Presets as the service hands them out: as they are, at one thickness, or over an axis of a link's own."""

import math
from functools import cache, lru_cache
from typing import NamedTuple

from nacreous.engine.cost import estimated_seconds
from nacreous.engine.work import Work
from nacreous.errors import MissingError, SpecError
from nacreous.formats.names import FormatName
from nacreous.optics.value import did_you_mean, shown
from nacreous.tables.presets import preset, preset_names
from nacreous.tables.spec import Spec
from nacreous.tables.spec_document import Document
from nacreous.web.admission import admit

__all__ = ["PresetWork", "check_preset", "preset_work"]

_PARAMETER = "thickness_scale"
_LEAST, _LARGEST = 1e-6, 100.0
"""Factors that the axis of a spec may hold."""
_LONGEST = 2000
"""Characters of the parameter."""


@cache
def _names() -> tuple[str, ...]:
    return preset_names()  # which looks into a folder


def check_preset(name: str) -> None:
    """Raise `MissingError`, with the closest names, where there is no preset of this one."""
    if name not in _names():
        remedy = did_you_mean(name, _names(), otherwise="/v1/presets lists them")
        raise MissingError(f"expected the name of a preset, got {shown(name)}; {remedy}")


class PresetWork(NamedTuple):
    """The work that makes a preset's file, and an estimate of what it takes."""

    work: Work
    seconds: float


@lru_cache(maxsize=512)
def preset_work(name: str, format_name: FormatName, thickness_scale: str = "") -> PresetWork:
    """Return the work that makes a preset's file.

    Parameters
    ----------
    name : str
    format_name : FormatName
    thickness_scale : str, optional
        A number is one factor on every layer's thickness, for a table of that one film. Anything else is the
        axis ``table.thickness_scale``, written as in a spec.

    Raises
    ------
    MissingError
        There is no such preset.
    SpecError
        The factor or the axis is none, or the format cannot hold the table.
    BudgetError
        The axis makes it too large.
    """
    check_preset(name)
    work = Work(_scaled(name, thickness_scale), format_name, name.replace("/", "-"))
    admit(work)
    return PresetWork(work, estimated_seconds(work))


def _scaled(name: str, thickness_scale: str) -> Spec:
    if not thickness_scale:
        return preset(name)
    if len(thickness_scale) > _LONGEST:
        raise SpecError(_PARAMETER, f"at most {_LONGEST} characters", f"{len(thickness_scale)}")
    factor = _number(thickness_scale)
    if factor is not None:
        return _at_one_thickness(preset(name), factor)
    try:
        return preset(name, [f"table.{_PARAMETER}={thickness_scale}"])
    except SpecError as error:
        raise SpecError(_PARAMETER, error.expected, error.got, error.remedy) from None


def _number(text: str) -> float | None:
    """Return the factor that a text is; None where it is no number, and so an axis or nothing."""
    try:
        factor = float(text)
    except ValueError:
        return None
    if not (math.isfinite(factor) and _LEAST <= factor <= _LARGEST):
        raise SpecError(_PARAMETER, f"a number from {_LEAST:g} to {_LARGEST:g}", shown(text))
    return factor


def _at_one_thickness(spec: Spec, factor: float) -> Spec:
    """Return the spec of the film that its own axis has at `factor`: deviations are scaled along."""
    document = spec.model_dump(mode="json")
    stack = {
        **document["stack"],
        "layers": [_thicker(layer, factor) for layer in document["stack"]["layers"]],
    }
    return Spec.from_document({**document, "stack": stack, "table": {**document["table"], _PARAMETER: 1}})


def _thicker(entry: Document, factor: float) -> Document:
    if "layers" in entry:
        return {**entry, "layers": [_thicker(layer, factor) for layer in entry["layers"]]}
    lengths = ("thickness_nm", "thickness_sigma_nm")
    return {name: value * factor if name in lengths else value for name, value in entry.items()}
