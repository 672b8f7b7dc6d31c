"""Reading the table with Blender's image nodes, for Cycles and EEVEE on every device."""

from pathlib import Path

import bpy

from .film_nodes import Film
from .lookup_texture import Axis, TextureError
from .node_graph import Graph

LONGEST_UNEVEN_AXIS = 64
"""Texels along an axis without even spacing: each takes two nodes."""


def read(film: Film) -> tuple[bpy.types.NodeSocket, bpy.types.NodeSocket | None]:
    """Return the colours of R and, if there is a file, of T."""
    texture, graph = film.texture, film.graph
    columns, rows = texture.columns, texture.rows
    place = graph.node("ShaderNodeCombineXYZ")
    across = _coordinate(graph, film.cos_theta, columns, *_centres(columns))
    # image nodes count V upwards: the top row, which is the first of the axis, lies near V = 1
    down = _coordinate(graph, film.thickness_scale, rows, *reversed(_centres(rows)))
    graph.connect(across, place.inputs["X"])
    graph.connect(down, place.inputs["Y"])
    paths = (texture.path, texture.transmission_path)
    R, T = (path and _colour(graph, load_table(path, columns, rows), place.outputs[0]) for path in paths)
    return R, T


def load_table(path: Path, columns: Axis, rows: Axis) -> bpy.types.Image:
    """Load the file as data, at full precision; raises `TextureError` where Blender cannot."""
    try:
        image = bpy.data.images.load(str(path), check_existing=True)
    except RuntimeError:
        raise TextureError(f"Blender cannot open {path}") from None
    if tuple(image.size) != (columns.count, rows.count):
        found = " x ".join(map(str, image.size))
        raise TextureError(
            f"{path.name}: expected {columns.count} x {rows.count} texels, Blender found {found}"
        )
    image.colorspace_settings.name = "Non-Color"
    image.alpha_mode = "NONE"
    image.use_half_precision = False
    return image


def _centres(axis: Axis) -> tuple[float, float]:
    """Return the coordinates of the first and the last texel's centre."""
    return 0.5 / axis.count, 1 - 0.5 / axis.count


def _coordinate(
    graph: Graph, value: bpy.types.NodeSocket, axis: Axis, at_first: float, at_last: float
) -> bpy.types.NodeSocket | float:
    """Return the coordinate of a place on an axis, clamped between the outermost texel centres."""
    if axis.values[0] == axis.values[-1]:
        return at_first
    if len(axis.values) > LONGEST_UNEVEN_AXIS:
        raise TextureError(f"An uneven axis may have {LONGEST_UNEVEN_AXIS} texels, not {axis.count}")
    # the sum over all cells of how far the value has come in each: one cell if the axis is even
    cells = list(zip(axis.values, axis.values[1:], strict=False))
    share = (at_last - at_first) / len(cells)
    first, *others = (_progress(graph, value, cell, share) for cell in cells)
    for other in others:
        first = graph.math("ADD", first, other)
    return graph.math("ADD", first, at_first)


def _progress(
    graph: Graph, value: bpy.types.NodeSocket, cell: tuple[float, float], whole: float
) -> bpy.types.NodeSocket:
    """Rise from 0 before a cell to `whole` behind it."""
    span = graph.node("ShaderNodeMapRange", clamp=True)
    graph.connect(value, span.inputs["Value"])
    for name, bound in zip(("From Min", "From Max", "To Min", "To Max"), (*cell, 0.0, whole), strict=True):
        span.inputs[name].default_value = bound
    return span.outputs["Result"]


def _colour(graph: Graph, image: bpy.types.Image, place: bpy.types.NodeSocket) -> bpy.types.NodeSocket:
    node = graph.node("ShaderNodeTexImage", image=image, interpolation="Linear", extension="EXTEND")
    graph.connect(place, node.inputs["Vector"])
    return node.outputs["Color"]
