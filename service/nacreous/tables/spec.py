"""The spec: one frozen value that says everything about a table, from TOML, JSON or Python.

The same spec gives the same bytes: nothing but its fields decides, and `canonical_json` is what is hashed.
"""

import json
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import AfterValidator, Field, ValidationError, model_validator

from nacreous.optics.stack import Stack
from nacreous.optics.surface import MAX_ALPHA, MIN_ALPHA, Surface, alphas_at
from nacreous.optics.value import Number, StrictModel, refusal
from nacreous.tables.axes import (
    HALF_TURN,
    QUARTER_TURN,
    WHOLE_TURN,
    phi_values,
    roughness_axis_values,
    theta_values,
)
from nacreous.tables.spec_document import Document, Syntax, override, parse, read, spec_error
from nacreous.tables.table_spec import TableSpec

__all__ = [
    "LABELS",
    "AccuracySpec",
    "BsdfAngles",
    "ColourSpec",
    "Spec",
    "TableSpec",
    "bsdf_angles",
    "canonical_json",
    "json_schema",
    "roughness_values",
    "surface_of",
    "with_bounds",
]

FloatArray = NDArray[np.float64]


def _check_printable(text: str) -> str:
    """Refuse control characters, which take over the terminal that shows them."""
    found = next((mark for mark in text if unicodedata.category(mark) == "Cc" and mark not in "\t\n"), "")
    if found:
        raise refusal("text without control characters, other than tabs and line ends", ascii(found))
    return text


Label = Annotated[str, Field(max_length=2000), AfterValidator(_check_printable)]
ColourScienceName = Annotated[str, Field(min_length=1, max_length=100)]

LABELS = ("name", "description", "source")
"""The fields of a spec that only a person reads; they are part neither of a table's id nor of its files."""

_BOUNDS = {"ge": "minimum", "le": "maximum", "gt": "exclusiveMinimum", "lt": "exclusiveMaximum"}

_ROUNDING = 1e-9
"""Relative slack at the ends of the roughness, which a ratio and a root are computed for."""


class ColourSpec(StrictModel):
    """How a spectrum becomes a colour.

    Parameters
    ----------
    illuminant : str
        The light under which the film is seen, by colour-science's name of it. ``A``, ``C``, ``D50``,
        ``D55``, ``D65``, ``D75`` and ``E`` ship with Nacreous. Others are ``D60``, the fluorescent lamps
        ``FL1`` to ``FL12``, and LEDs, such as ``LED-B1``.
    observer : str
        The colour-matching functions, by colour-science's name of them. ``CIE 1931 2 Degree Standard
        Observer`` and ``CIE 1964 10 Degree Standard Observer`` ship with Nacreous. Others are
        ``CIE 2015 2 Degree Standard Observer`` and ``CIE 2015 10 Degree Standard Observer``.
    space : str
        The linear RGB space of colour tables, or XYZ.
    """

    illuminant: ColourScienceName = "D65"
    observer: ColourScienceName = "CIE 1931 2 Degree Standard Observer"
    space: Literal["Rec.709", "ACEScg", "Rec.2020", "XYZ"] = "Rec.709"


class AccuracySpec(StrictModel):
    """How exactly a table is computed, and how closely its grid follows the film.

    Parameters
    ----------
    precision : str
        Precision of the kernels, ``"single"`` or ``"double"``.
    delta_e : float, optional
        Colour difference CIEDE2000, 0.05 to 10, that interpolation between the texels may reach; the axes of
        the spec are then lower bounds. A bsdf has none.
    """

    precision: Literal["single", "double"] = "single"
    delta_e: Annotated[Number, Field(ge=0.05, le=10)] | None = None


class Spec(StrictModel):
    """A thin-film structure and the table wanted of it.

    Parameters
    ----------
    name : str
        A label: what it is. Labels are not part of a table's id.
    description : str
        A label: what it shows.
    source : str
        A label: whose numbers it has.
    stack : Stack
        The film: its layers, and what lies in front of them and behind.
    surface : Surface, optional
        Without it the film is ideally smooth, or as rough as the table's roughness axis says.
    table : TableSpec
        What is tabulated, over which axes.
    colour : ColourSpec
        How spectra become colours.
    accuracy : AccuracySpec
        How exact the table is to be.

    Examples
    --------
    >>> film = {"material": {"n": 2.0}, "thickness_nm": 420}
    >>> spec = Spec.model_validate({"stack": {"incident": "air", "substrate": {"n": 1.5}, "layers": [film]}})
    >>> spec.stack.layers[0].thickness_nm
    420.0
    """

    name: Label = ""
    description: Label = ""
    source: Label = ""
    stack: Stack
    surface: Surface | None = None
    table: TableSpec = TableSpec()
    colour: ColourSpec = ColourSpec()
    accuracy: AccuracySpec = AccuracySpec()

    @model_validator(mode="after")
    def _check_across_sections(self) -> Self:
        _check_roughness(self)
        _check_phi_i(self)
        if self.table.quantity == "bsdf" and self.accuracy.delta_e is not None:
            expected = "nothing for a bsdf, whose angles are the spec's own"
            remedy = 'leave delta_e out, or take quantity = "fresnel" or "albedo"'
            raise refusal(expected, f"{self.accuracy.delta_e:g}", remedy, field="accuracy.delta_e")
        return self

    @classmethod
    def from_document(cls, document: Document, overrides: Iterable[str] = ()) -> Self:
        """Return the spec of a parsed document; raises `SpecError`, never pydantic's error."""
        try:
            return cls.model_validate(override(document, overrides))
        except ValidationError as error:
            raise spec_error(error) from None

    @classmethod
    def from_text(
        cls, text: str | bytes, syntax: Syntax = Syntax.TOML, overrides: Iterable[str] = ()
    ) -> Self:
        """Return the spec that a TOML or JSON document holds; raises `SpecError`."""
        return cls.from_document(parse(text, syntax), overrides)

    @classmethod
    def from_file(cls, path: str | Path, overrides: Iterable[str] = ()) -> Self:
        """Return the spec in a ``.toml`` or ``.json`` file; raises `SpecError`.

        Parameters
        ----------
        path : str or Path
        overrides : iterable of str
            Assignments such as ``"table.cos_theta=256"``, carried out before the spec is validated.
        """
        return cls.from_document(read(Path(path)), overrides)


@dataclass(frozen=True, eq=False)
class BsdfAngles:
    """Angles in radians of a bsdf: `theta_i` (I,), `theta_o` (O,), `phi` (P,), `phi_i` (Q,).

    `phi_i` is the one angle 0 for an isotropic surface, whose tables have no such axis.
    """

    theta_i: FloatArray
    theta_o: FloatArray
    phi: FloatArray
    phi_i: FloatArray


def surface_of(spec: Spec) -> Surface:
    """Return the surface of a spec: the default one where its roughness axis alone speaks of a surface."""
    return spec.surface or Surface()


def roughness_values(spec: Spec) -> FloatArray:
    """Return the roughnesses sqrt(alpha_x alpha_y) of a spec, (R,): its axis, or else its surface's own.

    There are none, R = 0, where the spec has neither; an albedo or a bsdf always has one.
    """
    if spec.table.roughness is not None:
        return roughness_axis_values(spec.table.roughness)
    own = surface_of(spec).roughness
    return np.array([] if own is None else [own], np.float64)


def bsdf_angles(spec: Spec) -> BsdfAngles:
    """Return the angles of a bsdf, with the defaults for its surface where the spec leaves them out."""
    table = spec.table
    anisotropic = surface_of(spec).anisotropic
    ends, count = (WHOLE_TURN, 37) if anisotropic else (HALF_TURN, 19)
    return BsdfAngles(
        theta_i=theta_values(table.theta_i, 16),
        theta_o=theta_values(table.theta_o, 32),
        phi=phi_values(table.phi, ends, count),
        phi_i=phi_values(table.phi_i, QUARTER_TURN, 5) if anisotropic else np.zeros(1),
    )


def _check_roughness(spec: Spec) -> None:
    """Require a roughness where the quantity has that axis, and alphas within bounds all along it."""
    if spec.table.quantity == "fresnel":
        return
    roughness = roughness_values(spec)
    if roughness.size == 0:
        expected = f"a roughness, for the quantity {spec.table.quantity}"
        remedy = "give [surface] alpha_x, or table.roughness"
        raise refusal(expected, "nothing", remedy, field="table.roughness")
    alphas = alphas_at(surface_of(spec), roughness)
    if alphas.min() < MIN_ALPHA * (1 - _ROUNDING) or alphas.max() > MAX_ALPHA * (1 + _ROUNDING):
        expected = f"a roughness whose alpha_x and alpha_y lie within {MIN_ALPHA:g} to {MAX_ALPHA:g}"
        got = f"alphas from {alphas.min():.3g} to {alphas.max():.3g}"
        remedy = f"alpha_x / alpha_y is {surface_of(spec).ratio:.4g} all along the axis: make it shorter"
        raise refusal(expected, got, remedy, field="table.roughness")


def _check_phi_i(spec: Spec) -> None:
    if spec.table.phi_i is not None and not surface_of(spec).anisotropic:
        expected = "no such axis: the surface is isotropic and looks the same from any azimuth"
        raise refusal(expected, "one", "leave it out, or give alpha_y", field="table.phi_i")


def canonical_json(spec: Spec) -> str:
    """Return what decides the bytes of `spec`'s tables: no labels, keys sorted, numbers in full precision."""
    fields: dict[str, Any] = spec.model_dump(mode="json", exclude=set(LABELS))
    if spec.table.quantity == "bsdf":
        del fields["table"]["cos_theta"]  # it has theta_i in its place
    return json.dumps(fields, sort_keys=True, separators=(",", ":"), ensure_ascii=True, allow_nan=False)


def json_schema() -> dict[str, Any]:
    """Return the JSON Schema of a spec."""
    schema: dict[str, Any] = with_bounds(Spec.model_json_schema())
    return schema


def with_bounds(part: Any) -> Any:  # noqa: ANN401 - any part of a schema
    """Return a schema whose bounds have JSON Schema's names; pydantic keeps its own before a validator."""
    if isinstance(part, list):
        return [with_bounds(entry) for entry in part]
    if not isinstance(part, dict):
        return part
    numeric = part.get("type") in ("number", "integer")
    return {_BOUNDS.get(name, name) if numeric else name: with_bounds(value) for name, value in part.items()}
