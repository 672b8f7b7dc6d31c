"""The spec: one frozen value that says everything about a table, from TOML, JSON or Python.

The same spec gives the same bytes: nothing but its fields decides, and `canonical_json` is what is hashed.
"""

import json
import unicodedata
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, Field, ValidationError

from nacreous.optics.stack import Stack
from nacreous.optics.value import Number, StrictModel, refusal
from nacreous.tables.axes import CosThetaAxis, Range, ThicknessScaleAxis, WavelengthAxis
from nacreous.tables.spec_document import Document, Syntax, override, parse, read, spec_error

__all__ = ["AccuracySpec", "ColourSpec", "Spec", "TableSpec", "canonical_json", "json_schema"]


def _check_printable(text: str) -> str:
    """Refuse control characters, which take over the terminal that shows them."""
    found = next((mark for mark in text if unicodedata.category(mark) == "Cc" and mark not in "\t\n"), "")
    if found:
        raise refusal("text without control characters, other than tabs and line ends", ascii(found))
    return text


Label = Annotated[str, Field(max_length=2000), AfterValidator(_check_printable)]
ColourScienceName = Annotated[str, Field(min_length=1, max_length=100)]

LABELS = ("name", "description", "source")
"""The fields of a spec that only a person reads; they are not part of a table's id."""


class TableSpec(StrictModel):
    """What is tabulated, over which axes.

    Parameters
    ----------
    quantity : str
        ``"fresnel"``: R and T of the film for s and p.
    wavelength_nm : list or range
        Vacuum wavelengths, 100 to 100,000 nm.
    cos_theta : count, list or range
        Cosines of the angle of incidence, 0 to 1; a count spaces them equally over [0, 1].
    thickness_scale : 1, list or range
        Factors on every layer's thickness.
    ellipsometry : bool
        Whether the table holds psi and Delta as well.
    """

    quantity: Literal["fresnel"] = "fresnel"
    wavelength_nm: WavelengthAxis = Range(start=350.0, stop=750.0, step=5.0)
    cos_theta: CosThetaAxis = 64
    thickness_scale: ThicknessScaleAxis = 1
    ellipsometry: bool = False


class ColourSpec(StrictModel):
    """How a spectrum becomes a colour.

    Parameters
    ----------
    illuminant, observer : str
        Names as colour-science has them; they are looked up where a colour is computed.
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
        the spec are then lower bounds.
    """

    precision: Literal["single", "double"] = "single"
    delta_e: Annotated[Number, Field(ge=0.05, le=10)] | None = None


class Spec(StrictModel):
    """A thin-film structure and the table wanted of it.

    Parameters
    ----------
    name, description, source : str
        Labels: what it is, what it shows, and whose numbers it has. They are not part of a table's id.
    stack : Stack
    table : TableSpec
    colour : ColourSpec
    accuracy : AccuracySpec

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
    table: TableSpec = TableSpec()
    colour: ColourSpec = ColourSpec()
    accuracy: AccuracySpec = AccuracySpec()

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


def canonical_json(spec: Spec) -> str:
    """Return what decides the bytes of `spec`'s tables: no labels, keys sorted, numbers in full precision."""
    fields: dict[str, Any] = spec.model_dump(mode="json", exclude=set(LABELS))
    return json.dumps(fields, sort_keys=True, separators=(",", ":"), ensure_ascii=True, allow_nan=False)


def json_schema() -> dict[str, Any]:
    """Return the JSON Schema of a spec."""
    return Spec.model_json_schema()
