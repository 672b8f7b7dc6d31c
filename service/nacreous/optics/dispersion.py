"""Dispersion formulas: the refractive index as a function of the vacuum wavelength in micrometres.

The nine formulas are those of the refractiveindex.info database (M. N. Polyanskiy, "Refractiveindex.info
database of optical constants", Sci. Data 11, 94 (2024)), with its numbering and its coefficients; tabulated
data is interpolated linearly, as that database does. A formula gives NaN where it has no real index.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Curve",
    "Dispersion",
    "Pairs",
    "cauchy",
    "exotic",
    "gases",
    "herzberger",
    "mixed_form",
    "polynomial",
    "retro",
    "sellmeier",
    "sellmeier_2",
    "tabulated",
]

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
Pairs = Sequence[tuple[float, float]]
Curve = Callable[[FloatArray], FloatArray]
"""n or k as a function of the wavelength in micrometres."""


@dataclass(frozen=True)
class Dispersion:
    """A refractive index n + ik over wavelength, and where it is known.

    Parameters
    ----------
    label : str
        What a message calls the material.
    range_nm : tuple of float
        The first and last wavelength of the data.
    index : callable
        Wavelengths in nm, shape (L,), to n + ik, complex, shape (L,).
    """

    label: str
    range_nm: tuple[float, float]
    index: Callable[[FloatArray], ComplexArray]


def sellmeier(wavelength_um: FloatArray, c1: float, terms: Pairs) -> FloatArray:
    """Evaluate formula 1, Sellmeier: n² - 1 = c1 + Σ B λ² / (λ² - C²), terms (B, C) with C in um."""
    return sellmeier_2(wavelength_um, c1, [(b, c**2) for b, c in terms])


def sellmeier_2(wavelength_um: FloatArray, c1: float, terms: Pairs) -> FloatArray:
    """Evaluate formula 2, Sellmeier-2: n² - 1 = c1 + Σ B λ² / (λ² - C), terms (B, C) with C in um²."""
    squared = wavelength_um**2
    return _root(_total(1 + c1, squared, (_ratio(b * squared, squared - c) for b, c in terms)))


def polynomial(wavelength_um: FloatArray, c1: float, terms: Pairs) -> FloatArray:
    """Evaluate formula 3, polynomial: n² = c1 + Σ c λ^e, terms (c, e)."""
    return _root(_powers(c1, wavelength_um, terms))


def mixed_form(
    wavelength_um: FloatArray,
    c1: float,
    rational_terms: Sequence[tuple[float, float, float, float]],
    polynomial_terms: Pairs,
) -> FloatArray:
    """Evaluate formula 4: n² = c1 + Σ B λ^e / (λ² - C^f) + Σ c λ^g, terms (B, e, C, f) and (c, g)."""
    rational = (_ratio(b * wavelength_um**e, wavelength_um**2 - c**f) for b, e, c, f in rational_terms)
    return _root(_total(c1, wavelength_um, rational) + _powers(0.0, wavelength_um, polynomial_terms))


def cauchy(wavelength_um: FloatArray, c1: float, terms: Pairs) -> FloatArray:
    """Evaluate formula 5, Cauchy: n = c1 + Σ c λ^e, terms (c, e)."""
    return _powers(c1, wavelength_um, terms)


def gases(wavelength_um: FloatArray, c1: float, terms: Pairs) -> FloatArray:
    """Evaluate formula 6, gases: n - 1 = c1 + Σ B / (C - λ⁻²), terms (B, C)."""
    return _total(1 + c1, wavelength_um, (_ratio(b, c - wavelength_um**-2.0) for b, c in terms))


def herzberger(
    wavelength_um: FloatArray, c1: float, c2: float, c3: float, c4: float, c5: float, c6: float
) -> FloatArray:
    """Evaluate formula 7, Herzberger: n = c1 + c2 L + c3 L² + c4 λ² + c5 λ⁴ + c6 λ⁶, L = 1 / (λ² - 0.028)."""
    pole = _ratio(1.0, wavelength_um**2 - 0.028)
    return c2 * pole + c3 * pole**2 + _powers(c1, wavelength_um, [(c4, 2), (c5, 4), (c6, 6)])


def retro(wavelength_um: FloatArray, c1: float, c2: float, c3: float, c4: float) -> FloatArray:
    """Evaluate formula 8, Retro: (n² - 1) / (n² + 2) = c1 + c2 λ² / (λ² - c3) + c4 λ²."""
    squared = wavelength_um**2
    ratio = c1 + _ratio(c2 * squared, squared - c3) + c4 * squared
    return _root(_ratio(1 + 2 * ratio, 1 - ratio))


def exotic(
    wavelength_um: FloatArray, c1: float, c2: float, c3: float, c4: float, c5: float, c6: float
) -> FloatArray:
    """Evaluate formula 9, exotic: n² = c1 + c2 / (λ² - c3) + c4 (λ - c5) / ((λ - c5)² + c6)."""
    shifted = wavelength_um - c5
    return _root(c1 + _ratio(c2, wavelength_um**2 - c3) + _ratio(c4 * shifted, shifted**2 + c6))


def tabulated(wavelength_um: FloatArray, at_um: ArrayLike, values: ArrayLike) -> FloatArray:
    """Interpolate `values` at the ascending wavelengths `at_um` linearly, and hold them beyond the ends."""
    return np.interp(wavelength_um, np.asarray(at_um, np.float64), np.asarray(values, np.float64))


def _powers(constant: float, wavelength_um: FloatArray, terms: Pairs) -> FloatArray:
    return _total(constant, wavelength_um, (c * wavelength_um ** float(e) for c, e in terms))


def _total(constant: float, like: FloatArray, terms: Iterable[FloatArray]) -> FloatArray:
    return sum(terms, np.full_like(like, constant))


def _ratio(numerator: FloatArray | float, denominator: FloatArray) -> FloatArray:
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.divide(numerator, denominator))


def _root(n_squared: FloatArray | float) -> FloatArray:
    with np.errstate(invalid="ignore"):
        return np.sqrt(np.asarray(n_squared, np.float64))
