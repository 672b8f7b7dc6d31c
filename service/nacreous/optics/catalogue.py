"""Finding a material by words: the project's own library and refractiveindex.info in one list."""

from dataclasses import dataclass

from nacreous.optics.library import library_material, library_names
from nacreous.optics.refractive_index_info import Page, is_page_name, page, search

__all__ = ["Listing", "describe_material", "search_materials"]


@dataclass(frozen=True)
class Listing:
    """What is known about one named material.

    Parameters
    ----------
    name : str
        What a spec calls it.
    description, citation : str
        What it is, and whose numbers it has.
    range_nm : tuple of float
        The wavelengths at which it can be used.
    """

    name: str
    description: str
    citation: str
    range_nm: tuple[float, float]


def describe_material(name: str) -> Listing:
    """Return what is known about a material of the library or a page; raises `SpecError` for neither."""
    return _of_page(page(name)) if is_page_name(name) else _of_library(name)


def search_materials(text: str) -> list[Listing]:
    """Return the materials whose name, description or citation holds every word of `text`, own ones first."""
    words = text.lower().split()
    own = [_of_library(name) for name in library_names()]
    found = [listing for listing in own if all(word in _searched(listing) for word in words)]
    return found + [_of_page(match) for match in search(text)]


def _searched(listing: Listing) -> str:
    return f"{listing.name} {listing.description} {listing.citation}".lower()


def _of_library(name: str) -> Listing:
    entry = library_material(name)
    return Listing(name, entry.note, entry.citation, entry.range_nm)


def _of_page(found: Page) -> Listing:
    description = f"{found.name}. {found.comments}" if found.comments else found.name
    return Listing(found.page, description, found.citation, found.range_nm)
