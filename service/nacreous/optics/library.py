"""The project's own materials: names for what refractiveindex.info lacks, and short names for what it has.

The data is ``library.toml`` beside this module. Every entry says where its numbers come from, also where
they are rounded textbook values.
"""

import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Annotated

from pydantic import Field

from nacreous.errors import SpecError
from nacreous.optics.material import Material
from nacreous.optics.value import AsTuple, Number, StrictModel, did_you_mean

__all__ = ["LibraryMaterial", "library_material", "library_names"]

_DATA = Path(__file__).with_name("library.toml")


class LibraryMaterial(StrictModel):
    """A named material.

    Parameters
    ----------
    model : Material
        Its refractive index; never another name of the library.
    range_nm : tuple of float
        The wavelengths at which the entry may be used.
    citation : str
        Whose numbers these are.
    note : str
        What a user should know about them.
    """

    model: Material
    range_nm: Annotated[tuple[Number, Number], AsTuple]
    citation: Annotated[str, Field(min_length=1)]
    note: str = ""


def library_names() -> tuple[str, ...]:
    """Return the names of all materials of the library, in alphabetical order."""
    return tuple(sorted(_library()))


def library_material(name: str) -> LibraryMaterial:
    """Return a material of the library; raises `SpecError` with the closest names where there is none."""
    try:
        return _library()[name]
    except KeyError:
        otherwise = "`nacreous materials` lists the names; a refractiveindex.info page is shelf/book/page"
        remedy = did_you_mean(name, _library(), otherwise=otherwise)
        raise SpecError("", "the name of a material", f'"{name}"', remedy) from None


@cache
def _library() -> Mapping[str, LibraryMaterial]:
    entries = tomllib.loads(_DATA.read_text(encoding="utf-8"))
    return MappingProxyType({name: LibraryMaterial.model_validate(entry) for name, entry in entries.items()})
