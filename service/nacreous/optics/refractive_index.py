"""Evaluate a material: its complex refractive index n + ik over vacuum wavelength.

One rule for every form: find its `Dispersion`, refuse or hold what lies beyond its range, evaluate,
and refuse what no passive film can have.
"""

from collections.abc import Callable, Mapping
from functools import partial, singledispatch
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nacreous.errors import SpecError
from nacreous.optics import dispersion
from nacreous.optics.dispersion import Curve, Dispersion
from nacreous.optics.effective_medium import bruggeman, lamellar, maxwell_garnett
from nacreous.optics.library import library_material
from nacreous.optics.material import (
    MAX_INDEX,
    MIN_REAL_INDEX,
    CauchyMaterial,
    ConstantMaterial,
    Material,
    Mixture,
    NamedMaterial,
    SellmeierMaterial,
    TabulatedMaterial,
)
from nacreous.optics.refractive_index_info import is_page_name, page_dispersion

__all__ = ["refractive_index"]

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

_EVERYWHERE = (0.0, np.inf)
_ROUNDING = 1e-9
"""Relative slack at the ends of a range, for wavelengths that were converted between units."""

_MIXING: Mapping[str, Callable[[ComplexArray, ComplexArray, float], ComplexArray]] = MappingProxyType(
    {"bruggeman": bruggeman, "maxwell-garnett": maxwell_garnett, "lamellar": lamellar}
)


def refractive_index(material: Material, wavelength_nm: ArrayLike) -> ComplexArray:
    """Return n + ik of `material`, shape (L,), at the vacuum wavelengths (L,) in nm.

    Raises
    ------
    SpecError
        The name is unknown, a wavelength lies outside the data (unless held), or n < 0.001, k < 0 or
        |n + ik| > 1000.
    """
    wavelengths = np.array(wavelength_nm, np.float64, ndmin=1)
    source = _dispersion(material)
    if getattr(material, "extrapolate", "refuse") == "hold":
        wavelengths = np.clip(wavelengths, *source.range_nm)
    else:
        _check_range(source, wavelengths)
    index = np.asarray(source.index(wavelengths), np.complex128)
    _check_index(source, wavelengths, index)
    return index


def _check_range(source: Dispersion, wavelength_nm: FloatArray) -> None:
    first, last = source.range_nm
    outside = (wavelength_nm < first * (1 - _ROUNDING)) | (wavelength_nm > last * (1 + _ROUNDING))
    if outside.any():
        expected = f"wavelengths within the data of {source.label}, {first:g} to {last:g} nm"
        remedy = 'narrow table.wavelength_nm, or give the material as a table with extrapolate = "hold"'
        raise SpecError("", expected, f"{wavelength_nm[outside][0]:g} nm", remedy)


def _check_index(source: Dispersion, wavelength_nm: FloatArray, index: ComplexArray) -> None:
    usable = (index.real >= MIN_REAL_INDEX) & (index.imag >= 0) & (np.abs(index) <= MAX_INDEX)
    if not usable.all():
        worst = int(np.argmin(usable))
        expected = f"n >= {MIN_REAL_INDEX:g}, k >= 0 and |n + ik| <= {MAX_INDEX:g} from {source.label}"
        got = f"n = {index[worst].real:.4g}, k = {index[worst].imag:.4g} at {wavelength_nm[worst]:g} nm"
        raise SpecError("", expected, got, "narrow the wavelengths, or take another material")


@singledispatch
def _dispersion(material: object) -> Dispersion:
    """Find the refractive index of one form of a material; each form registers below."""
    raise TypeError(f"{type(material).__name__} is not a material")


@_dispersion.register
def _named(material: NamedMaterial) -> Dispersion:
    if is_page_name(material.name):
        return page_dispersion(material.name)
    entry = library_material(material.name)
    first, last = entry.range_nm
    return Dispersion(material.name, (first, last), _dispersion(entry.model).index)


@_dispersion.register
def _constant(material: ConstantMaterial) -> Dispersion:
    label = f"n = {material.n:g}, k = {material.k:g}"
    return Dispersion(label, _EVERYWHERE, lambda nm: np.full(nm.shape, material.n + 1j * material.k))


@_dispersion.register
def _tabulated(material: TabulatedMaterial) -> Dispersion:
    at_nm, zeros = material.wavelength_nm, (0.0,) * len(material.wavelength_nm)
    n, k = (partial(dispersion.tabulated, at_um=at_nm, values=v) for v in (material.n, material.k or zeros))
    return Dispersion("the given table", (at_nm[0], at_nm[-1]), lambda nm: np.asarray(n(nm) + 1j * k(nm)))


@_dispersion.register
def _cauchy(material: CauchyMaterial) -> Dispersion:
    constant, *others = material.cauchy
    terms = list(zip(others, (-2.0, -4.0), strict=False))
    n = partial(dispersion.cauchy, c1=constant, terms=terms)
    return _formula("the given Cauchy formula", material, n)


@_dispersion.register
def _sellmeier(material: SellmeierMaterial) -> Dispersion:
    given = material.sellmeier
    terms = list(zip(given.b, given.c_um2, strict=True))
    n = partial(dispersion.sellmeier_2, c1=given.constant, terms=terms)
    return _formula("the given Sellmeier formula", material, n)


def _formula(label: str, material: CauchyMaterial | SellmeierMaterial, n: Curve) -> Dispersion:
    first, last = material.range_nm or _EVERYWHERE
    return Dispersion(label, (first, last), lambda nm: np.asarray(n(nm / 1e3) + 1j * material.k))


@_dispersion.register
def _mixture(material: Mixture) -> Dispersion:
    """Mix two materials, each of which has its own range and its own way beyond it."""

    def index(wavelength_nm: FloatArray) -> ComplexArray:
        host = _part("host", material.host, wavelength_nm)
        inclusion = _part("inclusion", material.inclusion, wavelength_nm)
        return _MIXING[material.rule](host, inclusion, material.fraction)

    return Dispersion("the mixture", _EVERYWHERE, index)


def _part(field: str, material: Material, wavelength_nm: FloatArray) -> ComplexArray:
    try:
        return refractive_index(material, wavelength_nm)
    except SpecError as error:
        raise error.under(field) from None
