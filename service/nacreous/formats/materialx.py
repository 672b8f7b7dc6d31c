"""``materialx``: a material for Maya, Houdini, USD and Arnold that reads the lookup texture beside it.

``film.mtlx`` belongs to ``film.exr`` and, where the substrate transmits, to ``film.transmission.exr``, which
are written with it and are files of the format ``exr``. The document has one material, ``film_material``, and
a node graph ``film`` with the inputs

======================  ====================================================================================
``reflection_file``     the texture of R, and ``transmission_file`` that of T, both with colour space ``none``
``thickness_scale``     factor on the thickness of the film, for tables with such an axis
``roughness``           GGX alpha along x and y, that of the spec's ``[surface]``, 0.001 without one
======================  ====================================================================================

and the outputs ``reflection`` and ``transmission``, the colours, and ``bsdf``. Axes of the table have to be
evenly spaced, because MaterialX has no lookup of uneven ones. The film is read at the angle to the surface's
normal: on rough surfaces, where facets lie at other angles, it is right about the middle of a highlight.

Provenance is in attributes of the material, ``nacreous:id`` and the rest. ``nacreous:checksum`` is over the
document and the values of its textures: all of them belong together.
"""

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from nacreous.errors import FileFormatError, SpecError, reason
from nacreous.formats import exr
from nacreous.formats.atlas import Atlas, atlas_of, table_atlas
from nacreous.formats.atomic import replacing
from nacreous.formats.contents import CHECKSUM, PREFIX, Contents, checksum, provenance_of
from nacreous.formats.lookup import coloured_names, colours, lookup_attributes, lookup_files
from nacreous.formats.materialx_graph import FilmGraph, document
from nacreous.formats.openexr import write_part
from nacreous.formats.spec_axes import spec_axes
from nacreous.formats.specular import check_specular
from nacreous.optics.surface import MIN_ALPHA
from nacreous.tables.digest import array_bytes
from nacreous.tables.measured.surface import check_rgb
from nacreous.tables.spec import Spec, surface_of
from nacreous.tables.table import Table

__all__ = ["QUANTITIES", "SUFFIX", "check", "read", "rename_textures", "write"]

SUFFIX = ".mtlx"
QUANTITIES = frozenset({"fresnel"})
"""MaterialX's lobe multiplies a colour of the film with facets of its own."""

_SIDES = ("reflection", "transmission")
_NAMESPACE = "urn:nacreous"
"""What the prefix of our attributes stands for, so that the document is XML for readers with namespaces."""
_ADVICE = "the format exr holds it; or leave delta_e out, and give table axes as a count or a range"


def check(spec: Spec) -> None:
    """Refuse a spec of uneven axes, or of what its document would lose; raises `SpecError`."""
    check_rgb(spec, "materialx")
    check_specular(spec, "materialx")
    if spec.accuracy.delta_e is not None:
        raise SpecError("accuracy.delta_e", "nothing for materialx, whose axes are even", "one", _ADVICE)
    uneven = _uneven(atlas_of(spec.table.quantity, spec_axes(spec)))
    if uneven:
        raise SpecError(f"table.{uneven[0]}", "evenly spaced values for materialx", "others", _ADVICE)


def _uneven(atlas: Atlas) -> list[str]:
    return [axis.name for axis in (atlas.x, atlas.y) if axis.described()["mapping"] != "linear"]


def write(table: Table, path: Path) -> tuple[Path, ...]:
    """Write the document and its textures, and return the files; raises `FileFormatError`."""
    if _uneven(table_atlas(table)):
        raise FileFormatError(f"expected evenly spaced axes for materialx, got others; {_ADVICE}")
    beside = path.with_name(f"{_stem(path)}{exr.SUFFIX}")
    names = coloured_names(table)
    files, obsolete = lookup_files(table, beside, exr.SUFFIX, names, exr.read)
    texels = {name: colours(table, name) for name in names}  # (H, W, 3)
    text = _sealed(table, dict(zip(_SIDES, files.values(), strict=False)), texels)
    with replacing(path, *files.values(), obsolete=obsolete) as (temporary, *textures):
        temporary.write_text(text, encoding="utf-8")
        for name, texture in zip(files, textures, strict=True):
            _write_texture(table, name, texels[name], texture)
    return (path, *files.values())


def _stem(path: Path) -> str:
    """Return the name without its suffix; all of it, where the textures' own suffix is there."""
    return path.name if path.suffix.lower() == exr.SUFFIX else path.stem


def _write_texture(table: Table, name: str, texels: NDArray[np.float32], path: Path) -> None:
    channels = {key: texels[..., at] for at, key in enumerate(table.values("channel").tolist())}
    write_part(path, channels, lookup_attributes(table, name))


def _sealed(table: Table, files: Mapping[str, Path], texels: Mapping[str, NDArray[np.float32]]) -> str:
    """Return the document's text, its checksum in it."""
    attributes = lookup_attributes(table, next(iter(texels)))
    root = document(_graph(table, files, attributes))
    root.set("xmlns:nacreous", _NAMESPACE)
    arrays = {f"{name}_rgb": values for name, values in texels.items()}
    seal = _checksum(ET.fromstring(ET.tostring(root)), arrays)  # noqa: S314 - our own document
    _material(root).set(CHECKSUM, seal)
    return f"<?xml version='1.0' encoding='utf-8'?>\n{ET.tostring(root, encoding='unicode')}\n"


def _graph(table: Table, files: Mapping[str, Path], attributes: Mapping[str, str]) -> FilmGraph:
    names = {side: file.name for side, file in files.items()}
    alphas = surface_of(table.spec).alphas or (MIN_ALPHA, MIN_ALPHA)
    return FilmGraph(names, table_atlas(table), alphas, attributes)


def rename_textures(path: Path, textures: Sequence[Path]) -> None:
    """Let a document name other files that hold the textures it was written with, as `write` would have.

    Parameters
    ----------
    path : Path
        The document.
    textures : sequence of Path
        That of R and, where there is one, that of T.

    Raises
    ------
    FileFormatError
        It is no such document, or has another number of textures.
    """
    root = _parsed(path)
    named, files = _files(root), [texture.name for texture in textures]
    if len(named) != len(files):
        raise FileFormatError(f"expected a document of {len(files)} textures, got one of {len(named)}")
    arrays: dict[str, NDArray[np.float32]] = {}
    for texture in textures:
        arrays |= exr.read(texture).arrays
    text = path.read_text(encoding="utf-8")
    for old, new in zip(named, files, strict=True):
        text = text.replace(f"value={_quoted(old)}", f"value={_quoted(new)}")
    seal = _checksum(ET.fromstring(text.encode()), arrays)  # noqa: S314 - parsed before
    former = _attributes(root)[CHECKSUM]
    path.write_text(
        text.replace(f"{CHECKSUM}={_quoted(former)}", f"{CHECKSUM}={_quoted(seal)}"), encoding="utf-8"
    )


def _quoted(value: str) -> str:
    """Return a value as it is written into a document."""
    return ET.tostring(ET.Element("a", {"b": value}), encoding="unicode")[len("<a b=") : -len(" />")]


# ---- reading -----------------------------------------------------------------------------------------------


def read(path: Path) -> Contents:
    """Return the textures' colours, (H, W, 3), and the document's attributes; raises `FileFormatError`."""
    root = _parsed(path)
    arrays: dict[str, NDArray[np.float32]] = {}
    for file in _files(root):
        arrays |= exr.read(path.with_name(file)).arrays
    return Contents(arrays, provenance_of(_attributes(root).items()), _checksum(root, arrays))


def _parsed(path: Path) -> ET.Element:
    try:
        text = path.read_text(encoding="utf-8")
        if "<!DOCTYPE" in text:
            raise FileFormatError("expected a MaterialX document, got one with a DOCTYPE")
        root = ET.fromstring(text.encode())  # noqa: S314 - it has no DOCTYPE, which all attacks need
    except (OSError, ValueError, ET.ParseError) as error:
        raise FileFormatError(
            f"expected a MaterialX document, got one that cannot be read: {reason(error)}"
        ) from error
    if root.find("surfacematerial") is None or not all(_files(root)) or not _files(root):
        raise FileFormatError("expected a material and the names of its textures, got none")
    return root


def _material(root: ET.Element) -> ET.Element:
    found = root.find("surfacematerial")
    if found is None:
        raise FileFormatError("expected a surfacematerial, got none")
    return found


def _files(root: ET.Element) -> list[str]:
    """Return the names of the textures, which are never anywhere but beside the document."""
    values = [node.get("value", "") for node in root.iterfind("nodegraph/input[@type='filename']")]
    return [Path(value).name for value in values]


def _attributes(root: ET.Element) -> dict[str, str]:
    """Return the material's attributes, under the names that other formats give them."""
    space = f"{{{_NAMESPACE}}}"
    return {key.replace(space, PREFIX): value for key, value in _material(root).items()}


def _checksum(root: ET.Element, arrays: Mapping[str, NDArray[np.float32]]) -> str:
    """Return the checksum over a parsed document, but for itself, and over its textures."""
    bare = ET.fromstring(ET.tostring(root))  # noqa: S314 - a copy of what was parsed
    _material(bare).attrib.pop(f"{{{_NAMESPACE}}}checksum", None)
    return checksum(_attributes(root).items(), [ET.tostring(bare), *array_bytes(arrays)])
