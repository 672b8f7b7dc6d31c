"""A material of a film, made from a lookup texture."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import MappingProxyType

import bpy

from . import image_reader, osl_reader
from .film_nodes import Reader, film_group
from .lookup_texture import LookupTexture

READERS: MappingProxyType[str, Reader] = MappingProxyType(
    {"IMAGE": image_reader.read, "OSL": osl_reader.read}
)
"""How the table is read, by the name that the operators' choice has."""


def film_material(path: Path, reader: str = "IMAGE") -> bpy.types.Material:
    """Return a new material with the film's node group.

    Parameters
    ----------
    path : Path
        The lookup texture of R; that of T is looked for beside it.
    reader : str
        A name in `READERS`.

    Raises
    ------
    TextureError
        The file is none that can be read; nothing is left in the blend file.
    """
    texture = LookupTexture.read(path)
    with nothing_left_of_failure():
        material = bpy.data.materials.new(texture.label)
        material.use_nodes = True
        _use_group(material.node_tree, film_group(texture, READERS[reader]))
        # EEVEE: blended where light passes straight on, traced where it is refracted
        if texture.transmission_path and texture.is_free_standing:
            material.surface_render_method = "BLENDED"
        material.use_raytrace_refraction = texture.transmission_path is not None
    return material


def _use_group(tree: bpy.types.ShaderNodeTree, group: bpy.types.ShaderNodeTree) -> None:
    tree.nodes.clear()
    film = tree.nodes.new("ShaderNodeGroup")
    film.node_tree, film.width, film.location = group, 220, (-280, 0)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(film.outputs["BSDF"], output.inputs["Surface"])


@contextmanager
def nothing_left_of_failure() -> Iterator[None]:
    """Remove every datablock that was made since, if an exception passes."""
    kinds = (bpy.data.materials, bpy.data.node_groups, bpy.data.images, bpy.data.texts)
    before = [set(kind) for kind in kinds]
    try:
        yield
    except Exception:
        for kind, known in zip(kinds, before, strict=True):
            for made in set(kind) - known:
                kind.remove(made)
        raise
