"""The rough surface that a film lies on: how its facets are distributed, hidden and weighted.

The surface is one of facets, each of which carries the film. Their normals h follow the distribution D, the
masking G says what share of them both directions see, and the film's reflectance at the angle to the facet
is the Fresnel term (F. Wu and C. Zheng 2015, equations 11 to 13). Nothing here has a unit.

=======================  ===============================================================================
``"ashikhmin-shirley"``  sqrt((e_x + 2)(e_y + 2)) / 2π (n·h)^(e_x cos²φ + e_y sin²φ): M. Ashikhmin and
                         P. Shirley 2000, the paper's equation 11
``"blinn"``              the same with e_x = e_y: J. Blinn 1977
``"phong"``              a cosine lobe about the mirror direction, for comparison: Y. Sun 2006
``"ggx"``                B. Walter et al. 2007, equation 33; anisotropic: E. Heitz 2014
``"beckmann"``           B. Walter et al. 2007, equation 25; anisotropic: E. Heitz 2014
=======================  ===============================================================================
"""

import math
from types import MappingProxyType
from typing import Annotated, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import AfterValidator, Field, model_validator
from pydantic.fields import FieldInfo

from nacreous.optics.value import Number, StrictModel, refusal

__all__ = [
    "MAX_ALPHA",
    "MAX_EXPONENT",
    "MIN_ALPHA",
    "Distribution",
    "Masking",
    "MultipleScattering",
    "Surface",
    "alpha_of",
    "alphas_at",
    "exponent_of",
]

FloatArray = NDArray[np.float64]

MIN_ALPHA, MAX_ALPHA = 1e-3, 1.0
"""Roughness: below the first a lobe is narrower than the sun, above the second most facets are steep."""
MAX_EXPONENT = 2 / MIN_ALPHA**2 - 2
MAX_WEIGHT = 1e3
"""Weights beyond it make any film that reflects a thousandth of the light create some."""

Distribution = Literal["ashikhmin-shirley", "blinn", "phong", "ggx", "beckmann"]
Masking = Literal["v-cavity", "smith", "smith-separable"]
MultipleScattering = Literal["none", "kulla-conty"]

_ISOTROPIC = frozenset({"blinn", "phong"})
"""Distributions of one roughness alone."""


def exponent_of(alpha: float) -> float:
    """Return the exponent of a roughness, 2 / alpha² - 2: Walter et al. 2007, section 5.2."""
    return 2 / alpha**2 - 2


def alpha_of(exponent: float) -> float:
    """Return the roughness of an exponent, sqrt(2 / (exponent + 2)): the inverse of `exponent_of`."""
    return math.sqrt(2 / (exponent + 2))


def _bounds(least: float, largest: float, what: str, remedy: str) -> tuple[AfterValidator, FieldInfo]:
    """Return what holds a number within bounds, and tells both the message and the schema of them."""

    def check(value: float) -> float:
        if not least <= value <= largest:
            raise refusal(f"{what} from {least:g} to {largest:.7g}", f"{value:g}", remedy)
        return value

    return AfterValidator(check), Field(json_schema_extra={"minimum": least, "maximum": largest})


_ALPHA = _bounds(MIN_ALPHA, MAX_ALPHA, "a roughness", "1 is the roughest; a smooth film has no [surface]")
_EXPONENT = _bounds(0.0, MAX_EXPONENT, "an exponent", "exponent = 2 / alpha^2 - 2; 0 is the roughest")
_WEIGHT = _bounds(0.0, MAX_WEIGHT, "a weight", "1 is the surface as it is, 0 leaves the term out")
_SHARE = _bounds(0.0, 1.0, "a share of the light", "0 is black, 1 is white")

Alpha = Annotated[Number, *_ALPHA]
Exponent = Annotated[Number, *_EXPONENT]
Weight = Annotated[Number, *_WEIGHT]
Share = Annotated[Number, *_SHARE]


class Surface(StrictModel):
    """A rough surface, its roughness given by alpha or by exponent, or left to a table's roughness axis.

    Parameters
    ----------
    distribution : str
        Distribution D of the facets, ``"ashikhmin-shirley"``, ``"blinn"``, ``"phong"``, ``"ggx"`` or
        ``"beckmann"``; ``"blinn"`` and ``"phong"`` are isotropic.
    alpha_x, alpha_y : float, optional
        Roughness along x and y, 0.001 to 1; y is x where it is left out.
    exponent_x, exponent_y : float, optional
        Roughness along x and y as exponents, 0 to 1,999,998: exponent = 2 / alpha² - 2.
    masking : str
        ``"v-cavity"``, the paper's equation 13 (Torrance and Sparrow 1967), ``"smith"``, height-correlated
        (Heitz 2014, equation 99), or ``"smith-separable"`` (Walter et al. 2007, equation 23). ``"phong"`` has
        ``"v-cavity"`` alone.
    specular_weight : float
        Factor on the light of the facets: the paper's c_b in its equation 12, 0 to 1000.
    diffuse_weight : float
        Factor on the diffuse term: the paper's c_a in its equation 12, 0 to 1000.
    diffuse_reflectance : float
        Albedo of the diffuse term, 0 to 1.
    multiple_scattering : str
        ``"none"``, as in the paper, or ``"kulla-conty"``: the light that several facets reflect is added (C.
        Kulla and A. Conty 2017), coloured by the film (S. Hill 2018); what they would transmit later is not.
        ``"phong"`` has ``"none"`` alone.
    """

    distribution: Distribution = "ashikhmin-shirley"
    alpha_x: Alpha | None = None
    alpha_y: Alpha | None = None
    exponent_x: Exponent | None = None
    exponent_y: Exponent | None = None
    masking: Masking = "v-cavity"
    specular_weight: Weight = 1.0
    diffuse_weight: Weight = 0.0
    diffuse_reflectance: Share = 0.0
    multiple_scattering: MultipleScattering = "none"

    @model_validator(mode="after")
    def _check(self) -> Self:
        _check_spelling(self)
        _check_isotropy(self)
        _check_lobe(self)
        return self

    @property
    def alphas(self) -> tuple[float, float] | None:
        """Roughness along x and y; None where only the roughness axis of a table says."""
        if self.exponent_x is not None:
            y = self.exponent_x if self.exponent_y is None else self.exponent_y
            return alpha_of(self.exponent_x), alpha_of(y)
        if self.alpha_x is None:
            return None
        return self.alpha_x, self.alpha_x if self.alpha_y is None else self.alpha_y

    @property
    def ratio(self) -> float:
        """alpha_x / alpha_y, which holds at every roughness; 1 where neither is given."""
        x, y = self.alphas or (1.0, 1.0)
        return x / y

    @property
    def anisotropic(self) -> bool:
        """Whether the surface changes as it turns about its normal."""
        return self.ratio != 1

    @property
    def roughness(self) -> float | None:
        """The surface's place on a roughness axis, sqrt(alpha_x alpha_y); None where it has no alphas."""
        return None if self.alphas is None else math.sqrt(self.alphas[0] * self.alphas[1])


def alphas_at(surface: Surface, roughness: FloatArray) -> FloatArray:
    """Return alpha_x and alpha_y of a surface, shape (R, 2), at the places (R,) of a roughness axis.

    Their ratio is the surface's own and their geometric mean the roughness.
    """
    stretch = math.sqrt(surface.ratio)
    return np.stack([roughness * stretch, roughness / stretch], axis=-1)


_SPELLINGS = ("alpha_x", "alpha_y", "exponent_x", "exponent_y")


def _check_spelling(surface: Surface) -> None:
    """Refuse two spellings of one roughness, and a y that has no x beside it."""
    given = [name for name in _SPELLINGS if getattr(surface, name) is not None]
    kinds = {name.partition("_")[0] for name in given}
    if len(kinds) > 1:
        remedy = "exponent = 2 / alpha^2 - 2: leave one of them out"
        raise refusal("either alpha or exponent", " and ".join(given), remedy, field=given[-1])
    for kind in kinds:
        if f"{kind}_x" not in given:
            remedy = f"give {kind}_x; {kind}_y stands beside it where it differs"
            raise refusal(f"{kind}_x beside {kind}_y", "nothing", remedy, field=f"{kind}_x")


def _check_isotropy(surface: Surface) -> None:
    if surface.distribution not in _ISOTROPIC or not surface.anisotropic:
        return
    kind = "alpha" if surface.exponent_x is None else "exponent"
    expected = f"the same as {kind}_x, {getattr(surface, f'{kind}_x'):.9g}, for {surface.distribution}"
    got = f"{getattr(surface, f'{kind}_y'):.9g}"
    raise refusal(expected, got, 'take distribution = "ashikhmin-shirley"', field=f"{kind}_y")


_OF_A_LOBE = MappingProxyType({"masking": "v-cavity", "multiple_scattering": "none"})
"""All that a phong lobe can have: it has no facets that Smith's masking could be derived from, and is up to a
twelfth brighter than the light it meets, so that there is nothing to give back."""


def _check_lobe(surface: Surface) -> None:
    if surface.distribution != "phong":
        return
    for field, only in _OF_A_LOBE.items():
        value = getattr(surface, field)
        if value != only:
            remedy = f'take distribution = "blinn", or leave {field} out'
            raise refusal(f'"{only}" for a phong lobe', f'"{value}"', remedy, field=field)
