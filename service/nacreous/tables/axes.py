"""The axes of a table: how a spec writes them, and the numbers they stand for.

An axis is a list, a range ``{ start, stop, step }`` or ``{ start, stop, count }``, or, where it has natural
ends, a count of equally spaced values between them. Its values ascend strictly and there are 2 to 65,536 of
them; a list of roughnesses or of the angles of a `bsdf` may hold one alone.
"""

import math
from collections.abc import Callable
from typing import Annotated, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import AfterValidator, BeforeValidator, Discriminator, Field, Tag, model_validator

from nacreous.optics.surface import MAX_ALPHA, MIN_ALPHA
from nacreous.optics.value import REFUSED, AsTuple, Number, StrictModel, form_tag, refusal

__all__ = [
    "HALF_TURN",
    "MAX_POINTS",
    "QUARTER_TURN",
    "WHOLE_TURN",
    "AzimuthAxis",
    "CosThetaAxis",
    "PolarAngleAxis",
    "Range",
    "RoughnessAxis",
    "ThicknessScaleAxis",
    "WavelengthAxis",
    "cos_theta_values",
    "one_of",
    "phi_values",
    "range_values",
    "roughness_axis_values",
    "theta_values",
    "thickness_scale_values",
    "wavelength_values_nm",
]

FloatArray = NDArray[np.float64]

MAX_POINTS = 65_536
"""Points of one axis; more is a slip of the keyboard, and no renderer loads an image that wide."""

QUARTER_TURN, HALF_TURN, WHOLE_TURN = (0.0, math.pi / 2), (0.0, math.pi), (-math.pi, math.pi)
"""Ends of an azimuth in radians, where it is a count."""

MAX_COUNTED_THETA = math.radians(89.0)
"""Where a count of polar angles ends: at 90 degrees there is no light, and no bsdf."""
MAX_THETA = 1.5707
"""Largest polar angle of a list or a range: its cosine is 1e-4."""
MAX_PHI = 3.1416
"""Largest azimuth: pi as it is written, so that nobody is refused for rounding it up."""

_MANY = 1e12
"""Points beyond which a message has no use for every digit."""

_WHOLE = 1e-6
"""How near to a whole number of steps counts as whole: a step such as 0.1 is not exact in binary."""


class Range(StrictModel):
    """Equally spaced values from `start`, by `step` or by `count`.

    A range by count ends at `stop`. A range by step ends at the last step that does not pass `stop`.

    Parameters
    ----------
    start : float
        First value.
    stop : float
        Where the values end; more than `start`.
    step : float, optional
        Distance from one value to the next; it or `count`.
    count : int, optional
        Number of values, both ends among them; it or `step`.
    """

    start: Number
    stop: Number
    step: Annotated[Number, Field(gt=0)] | None = None
    count: Annotated[int, Field(ge=2, le=MAX_POINTS)] | None = None

    @model_validator(mode="after")
    def _check_spacing(self) -> Self:
        if (self.step is None) == (self.count is None):
            got = "neither" if self.step is None else "both"
            raise refusal("either step or count", got, "for example { start = 350, stop = 750, step = 5 }")
        if self.stop <= self.start:
            raise refusal(f"more than start, {self.start:g}", f"{self.stop:g}", field="stop")
        points = _whole_steps(self) + 1
        if not 2 <= points <= MAX_POINTS:
            got = f"{points:,.0f}" if points < _MANY else f"{points:.3g}"
            raise refusal(f"2 to {MAX_POINTS:,} points", got, "choose another step", field="step")
        return self


def _whole_steps(axis: Range) -> float:
    """Return the number of steps that fit, infinite where it cannot be computed."""
    if axis.step is None:
        return (axis.count or 0) - 1
    steps = (axis.stop - axis.start) / axis.step
    return math.floor(steps + _WHOLE) if math.isfinite(steps) else math.inf


def _values(axis: Range | tuple[float, ...]) -> FloatArray:
    return range_values(axis) if isinstance(axis, Range) else np.array(axis, np.float64)


def range_values(axis: Range) -> FloatArray:
    """Return the values of a range."""
    steps = int(_whole_steps(axis))
    last = axis.stop if axis.step is None else axis.start + steps * axis.step
    # Where the steps fit, the last value is `stop` itself and not what rounding makes of it.
    fits = axis.step is None or abs(axis.stop - last) <= _WHOLE * axis.step
    return np.linspace(axis.start, axis.stop if fits else last, steps + 1)


def _within(least: float, largest: float, unit: str = "") -> AfterValidator:
    """Require ascending values from `least` to `largest`."""

    def check(axis: Range | tuple[float, ...]) -> Range | tuple[float, ...]:
        first, last = (axis.start, axis.stop) if isinstance(axis, Range) else (min(axis), max(axis))
        if first < least or last > largest:
            raise refusal(f"values from {least:g} to {largest:g}{unit}", f"{first:g} to {last:g}")
        _check_ascending(_values(axis))
        return axis

    return AfterValidator(check)


def _check_ascending(values: FloatArray) -> None:
    falls = np.flatnonzero(np.diff(values) <= 0)
    if falls.size:
        earlier, later = values[falls[0]], values[falls[0] + 1]
        raise refusal("strictly ascending values", f"{earlier:.12g} followed by {later:.12g}")


_LIST, _RANGE, _COUNT, _ABSENT = map(form_tag, ("list", "range", "count", "absent"))


def _form(value: object) -> str | None:
    if isinstance(value, list | tuple):
        return _LIST
    if isinstance(value, dict | Range):
        return _RANGE
    return _COUNT if isinstance(value, int) and not isinstance(value, bool) else None


def _spaced_form(value: object) -> str | None:
    """Return the form of an axis that has no natural ends, so that a count alone says nothing."""
    form = _form(value)
    return None if form == _COUNT else form


def _scale_form(value: object) -> str | None:
    """Return the form of an axis that is one thickness, 1 or 1.0, or has ends of its own."""
    one = isinstance(value, int | float) and not isinstance(value, bool) and value == 1
    return _COUNT if one else _spaced_form(value)


def _optional(form: Callable[[object], str | None]) -> Callable[[object], str | None]:
    """Let an axis be None as well: a spec that leaves it out."""
    return lambda value: _ABSENT if value is None else form(value)


def one_of(form: Callable[[object], str | None], expected: str) -> Discriminator:
    """Choose among the tagged forms of a value; `expected` is what a value of no form is told."""
    return Discriminator(
        form,
        custom_error_type=REFUSED,
        custom_error_message="expected {expected}",
        custom_error_context={"expected": expected},
    )


AxisList = Annotated[tuple[Number, ...], Field(min_length=2, max_length=MAX_POINTS), AsTuple]
SliceList = Annotated[tuple[Number, ...], Field(min_length=1, max_length=MAX_POINTS), AsTuple]
_WAVELENGTH_NM = _within(100.0, 100_000.0, " nm")
_COSINE = _within(0.0, 1.0)
_SCALE = _within(1e-6, 100.0)
_ROUGHNESS = _within(MIN_ALPHA, MAX_ALPHA)
_THETA = _within(0.0, MAX_THETA, " rad")
_PHI = _within(-MAX_PHI, MAX_PHI, " rad")

WavelengthAxis = Annotated[
    Annotated[AxisList, _WAVELENGTH_NM, Tag(_LIST)] | Annotated[Range, _WAVELENGTH_NM, Tag(_RANGE)],
    one_of(_spaced_form, "a list, { start, stop, step } or { start, stop, count }"),
]
"""Vacuum wavelengths in nm: a list or a range."""

CosThetaAxis = Annotated[
    Annotated[int, Field(ge=2, le=MAX_POINTS), Tag(_COUNT)]
    | Annotated[AxisList, _COSINE, Tag(_LIST)]
    | Annotated[Range, _COSINE, Tag(_RANGE)],
    one_of(_form, "a count over [0, 1], a list, { start, stop, step } or { start, stop, count }"),
]
"""Cosines of the angle of incidence: a count over [0, 1], a list or a range."""

ThicknessScaleAxis = Annotated[
    Annotated[Literal[1], BeforeValidator(int), Tag(_COUNT)]
    | Annotated[AxisList, _SCALE, Tag(_LIST)]
    | Annotated[Range, _SCALE, Tag(_RANGE)],
    one_of(_scale_form, "1, a list, { start, stop, step } or { start, stop, count }"),
]
"""Factors on every layer's thickness: 1 for the thickness as it is, a list or a range."""

RoughnessAxis = Annotated[
    Annotated[SliceList, _ROUGHNESS, Tag(_LIST)]
    | Annotated[Range, _ROUGHNESS, Tag(_RANGE)]
    | Annotated[None, Tag(_ABSENT)],
    one_of(_optional(_spaced_form), "a list, { start, stop, step } or { start, stop, count }"),
]
"""Roughness sqrt(alpha_x alpha_y), 0.001 to 1: a list or a range; None where the surface's own is meant."""

PolarAngleAxis = Annotated[
    Annotated[int, Field(ge=2, le=MAX_POINTS), Tag(_COUNT)]
    | Annotated[SliceList, _THETA, Tag(_LIST)]
    | Annotated[Range, _THETA, Tag(_RANGE)]
    | Annotated[None, Tag(_ABSENT)],
    one_of(_optional(_form), "a count over 0 to 89 degrees, a list or a range in radians"),
]
"""Angles from the normal in radians: a count over 0 to 89 degrees, a list, a range, or None."""

AzimuthAxis = Annotated[
    Annotated[int, Field(ge=2, le=MAX_POINTS), Tag(_COUNT)]
    | Annotated[SliceList, _PHI, Tag(_LIST)]
    | Annotated[Range, _PHI, Tag(_RANGE)]
    | Annotated[None, Tag(_ABSENT)],
    one_of(_optional(_form), "a count, a list or a range in radians"),
]
"""Angles about the normal in radians: a count over what symmetry leaves of them, a list, a range, or None."""


def wavelength_values_nm(axis: Range | tuple[float, ...]) -> FloatArray:
    """Return the wavelengths in nm, shape (L,)."""
    return _values(axis)


def cos_theta_values(axis: Range | tuple[float, ...] | int) -> FloatArray:
    """Return the cosines, shape (A,): from grazing, 0, to normal incidence, 1, where the axis is a count."""
    return np.linspace(0.0, 1.0, axis) if isinstance(axis, int) else _values(axis)


def thickness_scale_values(axis: Range | tuple[float, ...] | int) -> FloatArray:
    """Return the factors on every thickness, shape (S,)."""
    return np.ones(1) if isinstance(axis, int) else _values(axis)


def roughness_axis_values(axis: Range | tuple[float, ...]) -> FloatArray:
    """Return the roughnesses, shape (R,)."""
    return _values(axis)


def theta_values(axis: Range | tuple[float, ...] | int | None, default_count: int) -> FloatArray:
    """Return angles from the normal in radians; None is the count that is the default."""
    counted = default_count if axis is None else axis
    return np.linspace(0.0, MAX_COUNTED_THETA, counted) if isinstance(counted, int) else _values(counted)


def phi_values(
    axis: Range | tuple[float, ...] | int | None, ends: tuple[float, float], default_count: int
) -> FloatArray:
    """Return angles about the normal in radians; a count spaces them equally from one end to the other."""
    counted = default_count if axis is None else axis
    return np.linspace(*ends, counted) if isinstance(counted, int) else _values(counted)
