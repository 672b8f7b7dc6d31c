"""Reading the table with the OSL shader of clients/osl, for Cycles on the CPU and on OptiX."""

from pathlib import Path

import bpy

from .film_nodes import Film
from .lookup_texture import LookupTexture, TextureError

SHADER = "nacreous_film.osl"
FOLDERS = (Path(__file__).parent, Path(__file__).parent.parent / "osl")
"""Where the shader lies in a packed extension, and in a checkout."""
FIRST_WITH_V_UP = (5, 0, 0)
"""Blender from which OSL's ``texture()`` counts V upwards, as image nodes do."""


def read(film: Film) -> tuple[bpy.types.NodeSocket, bpy.types.NodeSocket | None]:
    """Return the colours of R and, if there is a file, of T; raises `TextureError`."""
    node = film.graph.node("ShaderNodeScript")
    node.script = bpy.data.texts.load(str(shader_path()))
    if "R" not in node.outputs:
        raise TextureError("Blender could not compile the OSL shader: its console says why")
    for name, value in parameters(film.texture).items():
        node.inputs[name].default_value = value
    film.graph.connect(film.cos_theta, node.inputs["cos_theta"])
    film.graph.connect(film.thickness_scale, node.inputs["thickness_scale"])
    return node.outputs["R"], node.outputs["T"] if film.texture.transmission_path else None


def parameters(texture: LookupTexture) -> dict[str, str | int | float | bool]:
    """Return what the shader must be told of a texture; raises `TextureError`."""
    if not (texture.columns.is_even and texture.rows.is_even):
        raise TextureError("The OSL shader reads evenly spaced axes only: choose image nodes")
    return {
        "Reflection texture": str(texture.path),
        "Transmission texture": str(texture.transmission_path or ""),
        "columns": texture.columns.count,
        "rows": texture.rows.count,
        "cos_theta_first": texture.columns.values[0],
        "cos_theta_last": texture.columns.values[-1],
        "thickness_first": texture.rows.values[0],
        "thickness_last": texture.rows.values[-1],
        "flip_v": bpy.app.version >= FIRST_WITH_V_UP,
    }


def shader_path() -> Path:
    """Return the file of the shader; raises `TextureError`."""
    for folder in FOLDERS:
        if (folder / SHADER).is_file():
            return folder / SHADER
    raise TextureError(f"{SHADER} is missing: expected in " + " or ".join(map(str, FOLDERS)))
