"""The materials that the service lists: searched in memory, each sampled where it is known."""

from dataclasses import asdict
from functools import cache

import numpy as np

from nacreous.errors import MissingError, SpecError
from nacreous.optics.catalogue import Listing, describe_material, search_materials
from nacreous.optics.material import NamedMaterial
from nacreous.optics.refractive_index import refractive_index
from nacreous.web.answers import MaterialAnswer, MaterialEntry, MaterialList, Samples

__all__ = ["describe", "find"]

_VISIBLE_NM = (380.0, 780.0)
_SAMPLES = 81


@cache
def _catalogue() -> tuple[tuple[str, Listing], ...]:
    """Return every material, and the text that words are looked for in."""
    listings = search_materials("")
    return tuple((f"{each.name} {each.description} {each.citation}".lower(), each) for each in listings)


def find(text: str, offset: int, limit: int) -> MaterialList:
    """Return a page of the materials in whose name, description or citation every word of `text` occurs."""
    words = text.lower().split()
    found = [listing for searched, listing in _catalogue() if all(word in searched for word in words)]
    page = [MaterialEntry(**asdict(listing)) for listing in found[offset : offset + limit]]
    return MaterialList(materials=page, total=len(found))


def describe(name: str) -> MaterialAnswer:
    """Return what is known of a material, with samples; raises `MissingError`."""
    try:
        listing = describe_material(name)
    except SpecError as error:
        raise MissingError(str(error)) from None
    return MaterialAnswer(**asdict(listing), samples=_samples(listing))


def _samples(listing: Listing) -> Samples:
    """Sample the visible part of what is known, or all where none is visible; nothing where n is unknown."""
    first, last = listing.range_nm
    visible = max(first, _VISIBLE_NM[0]), min(last, _VISIBLE_NM[1])
    ends = visible if visible[0] < visible[1] else (first, last)
    at_nm = np.linspace(*ends, _SAMPLES if ends[0] < ends[1] else 1)
    try:
        index = refractive_index(NamedMaterial(name=listing.name), at_nm)
    except SpecError:
        return Samples(wavelength_nm=[], n=[], k=[])
    return Samples(wavelength_nm=at_nm.tolist(), n=index.real.tolist(), k=index.imag.tolist())
