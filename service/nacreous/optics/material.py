"""The materials of a spec: everything that can stand where a refractive index n + ik is wanted.

==================================================================  ==========================================
``"chitin"``, ``{ name = "chitin", extrapolate = "hold" }``          a name from the project's own library
``"main/Ag/Johnson"``                                                a page of refractiveindex.info
``{ n = 1.5, k = 0.0 }``                                             a constant; k is 0 where it is left out
``{ wavelength_nm = […], n = […], k = […] }``                        a table, interpolated linearly
``{ cauchy = [A, B, C] }``                                           n = A + B/λ² + C/λ⁴, λ in micrometres
``{ sellmeier = { b = […], c_um2 = […] } }``                         n² = 1 + Σ b λ² / (λ² - c_um2)
``{ host = …, inclusion = …, fraction = 0.3, rule = "bruggeman" }``  a mixture of two materials
==================================================================  ==========================================

`nacreous.optics.refractive_index` evaluates them.
"""

from itertools import pairwise
from typing import Annotated, Any, Literal, Self

from pydantic import (
    Discriminator,
    Field,
    GetJsonSchemaHandler,
    SerializerFunctionWrapHandler,
    Tag,
    model_serializer,
    model_validator,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from nacreous.optics.value import REFUSED, AsTuple, Extrapolation, Number, StrictModel, form_tag, refusal

__all__ = [
    "MAX_INDEX",
    "MIN_REAL_INDEX",
    "CauchyMaterial",
    "ConstantMaterial",
    "Material",
    "Mixture",
    "NamedMaterial",
    "SellmeierCoefficients",
    "SellmeierMaterial",
    "TabulatedMaterial",
]

MIN_REAL_INDEX = 1e-3
"""Smallest n: below it 1/n² no longer fits what single precision resolves."""
MAX_INDEX = 1e3
"""Largest |n + ik|; the largest of any known material in the tabulated range is a few hundred."""
MAX_MIXTURE_DEPTH = 4
"""Mixtures within one another; their number can double with every level."""

RealIndex = Annotated[Number, Field(ge=MIN_REAL_INDEX, le=MAX_INDEX)]
Extinction = Annotated[Number, Field(ge=0, le=MAX_INDEX)]
PositiveWavelength = Annotated[Number, Field(gt=0)]


class NamedMaterial(StrictModel):
    """A material of the project's own library, or a refractiveindex.info page ``shelf/book/page``.

    Parameters
    ----------
    name : str
        A name that ``nacreous materials`` lists, or a page such as ``main/Ag/Johnson``.
    extrapolate : str
        Beyond the wavelengths of its data ``"refuse"`` a table, or ``"hold"`` the value at the nearer end.
    """

    name: str = Field(min_length=1, max_length=200)
    extrapolate: Extrapolation = "refuse"

    @model_validator(mode="before")
    @classmethod
    def _from_bare_name(cls, value: Any) -> Any:  # noqa: ANN401 - raw input
        return {"name": value} if isinstance(value, str) else value

    @model_serializer(mode="wrap")
    def _as_bare_name(self, serialise: SerializerFunctionWrapHandler) -> str | dict[str, Any]:
        return self.name if self.extrapolate == "refuse" else serialise(self)

    @classmethod
    def __get_pydantic_json_schema__(
        cls, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Describe both spellings: the bare name and the table."""
        table = handler.resolve_ref_schema(super().__get_pydantic_json_schema__(schema, handler))
        bare = dict(table["properties"]["name"]) | {"title": "Material name"}
        return {"anyOf": [bare, table], "description": table["description"]}


class ConstantMaterial(StrictModel):
    """The same n + ik at every wavelength.

    Parameters
    ----------
    n : float
        Refractive index.
    k : float
        Extinction coefficient: positive where the material absorbs.
    """

    n: RealIndex
    k: Extinction = 0.0


class TabulatedMaterial(StrictModel):
    """n and k at ascending wavelengths, linear between them.

    Parameters
    ----------
    wavelength_nm : tuple of float
        Vacuum wavelengths of the samples, ascending.
    n : tuple of float
        Refractive index at each of them, 0.001 to 1000.
    k : tuple of float, optional
        Extinction coefficient at each of them, 0 to 1000; 0 where it is left out.
    extrapolate : str
        Beyond the wavelengths ``"refuse"`` a table, or ``"hold"`` the value at the nearer end.
    """

    wavelength_nm: Annotated[tuple[Number, ...], Field(min_length=2, max_length=65_536), AsTuple]
    n: Annotated[tuple[Number, ...], AsTuple]
    k: Annotated[tuple[Number, ...], AsTuple] | None = None
    extrapolate: Extrapolation = "refuse"

    @model_validator(mode="after")
    def _check_table(self) -> Self:
        _check_ascending(self.wavelength_nm, "wavelength_nm")
        _check_column("n", self.n, len(self.wavelength_nm), MIN_REAL_INDEX)
        if self.k is not None:
            _check_column("k", self.k, len(self.wavelength_nm), 0.0)
        return self


class CauchyMaterial(StrictModel):
    """n = A + B/λ² + C/λ⁴ with λ in micrometres and a constant k, known over `range_nm`.

    Parameters
    ----------
    cauchy : tuple of float
        A, B in µm² and C in µm⁴; what is left out is 0.
    k : float
        Extinction coefficient.
    range_nm : tuple of float, optional
        First and last vacuum wavelength at which the formula holds; any, without it.
    extrapolate : str
        Beyond `range_nm` ``"refuse"`` a table, or ``"hold"`` the value at the nearer end.
    """

    cauchy: Annotated[tuple[Number, ...], Field(min_length=1, max_length=3), AsTuple]
    k: Extinction = 0.0
    range_nm: Annotated[tuple[Number, Number], AsTuple] | None = None
    extrapolate: Extrapolation = "refuse"

    @model_validator(mode="after")
    def _check_range(self) -> Self:
        _check_ascending(self.range_nm or (1.0, 2.0), "range_nm")
        return self


class SellmeierCoefficients(StrictModel):
    """n² = 1 + constant + Σ b λ² / (λ² - c_um2) with λ in micrometres.

    Parameters
    ----------
    b : tuple of float
        Strengths of the resonances.
    c_um2 : tuple of float
        Squares of their wavelengths, as many as `b` has.
    constant : float
        What resonances far away add.
    """

    b: Annotated[tuple[Number, ...], Field(min_length=1, max_length=16), AsTuple]
    c_um2: Annotated[tuple[Number, ...], AsTuple]
    constant: Number = 0.0

    @model_validator(mode="after")
    def _check_lengths(self) -> Self:
        if len(self.b) != len(self.c_um2):
            expected = f"as many values as b has, {len(self.b)}"
            raise refusal(expected, f"{len(self.c_um2)} values", field="c_um2")
        return self


class SellmeierMaterial(StrictModel):
    """A Sellmeier formula and a constant k, known over `range_nm`.

    Parameters
    ----------
    sellmeier : SellmeierCoefficients
        The formula's coefficients.
    k : float
        Extinction coefficient.
    range_nm : tuple of float, optional
        First and last vacuum wavelength at which the formula holds; any, without it.
    extrapolate : str
        Beyond `range_nm` ``"refuse"`` a table, or ``"hold"`` the value at the nearer end.
    """

    sellmeier: SellmeierCoefficients
    k: Extinction = 0.0
    range_nm: Annotated[tuple[Number, Number], AsTuple] | None = None
    extrapolate: Extrapolation = "refuse"

    @model_validator(mode="after")
    def _check_range(self) -> Self:
        _check_ascending(self.range_nm or (1.0, 2.0), "range_nm")
        return self


class Mixture(StrictModel):
    """Inclusions of volume share `fraction` in a host, far finer than the wavelength.

    They are spheres by the rules ``"bruggeman"`` and ``"maxwell-garnett"``, and by ``"lamellar"`` upright
    lamellae, such as ridges on a wing: see `nacreous.optics.effective_medium`.

    Parameters
    ----------
    host, inclusion : Material
        One of the two materials; it may be a mixture itself, four deep at most.
    fraction : float
        Share of the inclusions in the volume.
    rule : str
        How both make one index: ``"bruggeman"``, ``"maxwell-garnett"`` or ``"lamellar"``.
    """

    host: "Material"
    inclusion: "Material"
    fraction: Annotated[Number, Field(ge=0, le=1)]
    rule: Literal["bruggeman", "maxwell-garnett", "lamellar"]

    @model_validator(mode="after")
    def _check_depth(self) -> Self:
        if _mixture_depth(self) > MAX_MIXTURE_DEPTH:
            raise refusal(f"mixtures at most {MAX_MIXTURE_DEPTH} deep", "deeper ones")
        return self


def _mixture_depth(material: object) -> int:
    """Count the mixtures within one another; validated inside out, so the recursion is short."""
    if not isinstance(material, Mixture):
        return 0
    return 1 + max(_mixture_depth(material.host), _mixture_depth(material.inclusion))


def _check_ascending(wavelength_nm: tuple[float, ...], field: str) -> None:
    for earlier, later in pairwise(wavelength_nm):
        if not 0 < earlier < later:
            got = f"{earlier:g} followed by {later:g}"
            raise refusal("positive, strictly ascending wavelengths", got, field=field)


def _check_column(field: str, values: tuple[float, ...], length: int, least: float) -> None:
    if len(values) != length:
        expected = f"as many values as wavelength_nm has, {length}"
        raise refusal(expected, f"{len(values)} values", field=field)
    if not all(least <= value <= MAX_INDEX for value in values):
        got = f"values from {min(values):g} to {max(values):g}"
        raise refusal(f"values from {least:g} to {MAX_INDEX:g}", got, field=field)


_FORMS: dict[type[StrictModel], tuple[str, ...]] = {
    NamedMaterial: ("name",),
    CauchyMaterial: ("cauchy",),
    SellmeierMaterial: ("sellmeier",),
    Mixture: ("host", "inclusion", "fraction", "rule"),
    TabulatedMaterial: ("wavelength_nm",),
    ConstantMaterial: ("n", "k"),
}
"""The fields by which each form of a material is recognised, in the order in which they are looked for."""


def _form(value: object) -> str | None:
    """Return the tag of the form that `value` takes, so that a message speaks of that form alone."""
    if isinstance(value, str):
        return _tag(NamedMaterial)
    if isinstance(value, dict):
        return next(
            (_tag(form) for form, fields in _FORMS.items() if not value.keys().isdisjoint(fields)), None
        )
    return _tag(type(value)) if type(value) in _FORMS else None


def _tag(form: type) -> str:
    return form_tag(form.__name__)


Material = Annotated[
    Annotated[NamedMaterial, Tag(_tag(NamedMaterial))]
    | Annotated[ConstantMaterial, Tag(_tag(ConstantMaterial))]
    | Annotated[TabulatedMaterial, Tag(_tag(TabulatedMaterial))]
    | Annotated[CauchyMaterial, Tag(_tag(CauchyMaterial))]
    | Annotated[SellmeierMaterial, Tag(_tag(SellmeierMaterial))]
    | Annotated[Mixture, Tag(_tag(Mixture))],
    Discriminator(
        _form,
        custom_error_type=REFUSED,
        custom_error_message="expected {expected}",
        custom_error_context={
            "expected": "a name, or a table of n and k, wavelength_nm, cauchy, sellmeier or host",
            "remedy": 'for example "water", "main/Ag/Johnson" or { n = 1.5, k = 0.0 }',
        },
    ),
]
"""Any form of a material; a bare string is a name."""

Mixture.model_rebuild()
