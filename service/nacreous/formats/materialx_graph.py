"""The nodes of a MaterialX document that reads the lookup texture.

    normal . view direction -> |cos theta| -> column,  thickness_scale -> row
    column, row -> image -> generalized_schlick_bsdf -> surface -> surfacematerial

Schlick's curve runs from color0 to color90, so one colour at both ends is that colour at any angle: that of
the film, read at the angle to the surface's normal.
"""

import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass

from nacreous.formats.atlas import Atlas, Axis

__all__ = ["FilmGraph", "document"]

_VERSION = "1.39"
_GRAPH, _SURFACE, _MATERIAL = "film", "film_surface", "film_material"
_REFLECTION, _TRANSMISSION = "reflection", "transmission"


@dataclass(frozen=True, eq=False)
class FilmGraph:
    """What a document is made of.

    Parameters
    ----------
    files : mapping of str to str
        File names, relative to the document, of ``"reflection"`` and, where there is one, ``"transmission"``.
    atlas : Atlas
        Axes of the texture, evenly spaced: cos_theta across, thickness_scale down.
    alphas : pair of float
        Roughness along x and y.
    attributes : mapping of str to str
        Of the material.
    """

    files: Mapping[str, str]
    atlas: Atlas
    alphas: tuple[float, float]
    attributes: Mapping[str, str]


def document(graph: FilmGraph) -> ET.Element:
    """Return the document."""
    root = ET.Element("materialx", {"version": _VERSION})
    nodes = ET.SubElement(root, "nodegraph", {"name": _GRAPH})
    _add_interface(nodes, graph)
    _add_place(nodes, graph.atlas)
    for side, bsdf in ((_REFLECTION, _add_reflection), (_TRANSMISSION, _add_transmission)):
        if side in graph.files:
            _add_texture(nodes, side)
            bsdf(nodes)
    _add_outputs(nodes, graph)
    surface = _node(root, "surface", _SURFACE, "surfaceshader")
    ET.SubElement(surface, "input", {"name": "bsdf", "type": "BSDF", "nodegraph": _GRAPH, "output": "bsdf"})
    material = _node(root, "surfacematerial", _MATERIAL, "material")
    _connect(material, "surfaceshader", "surfaceshader", _SURFACE)
    material.attrib.update(graph.attributes)
    ET.indent(root)
    return root


# ---- the parts of the node graph ---------------------------------------------------------------------------


def _add_interface(nodes: ET.Element, graph: FilmGraph) -> None:
    for side, file in graph.files.items():
        # Values, not colours for a screen: "none" is MaterialX's word for raw.
        _value(nodes, _file(side), "filename", file).set("colorspace", "none")
    _value(nodes, "thickness_scale", "float", "1")
    _value(nodes, "roughness", "vector2", ", ".join(f"{alpha:.6g}" for alpha in graph.alphas))


def _add_place(nodes: ET.Element, atlas: Atlas) -> None:
    """Add what finds the place in the texture: centres of texels, and V counted upwards."""
    for name in ("normal", "viewdirection"):
        _value(_node(nodes, name, name, "vector3"), "space", "string", "world")
    product = _node(nodes, "dotproduct", "normal_dot_view", "float")
    _connect(product, "in1", "vector3", "normal")
    _connect(product, "in2", "vector3", "viewdirection")
    # MaterialX's view direction points from the eye to the surface, and a sheet is seen from both sides.
    _connect(_node(nodes, "absval", "cos_theta", "float"), "in", "float", "normal_dot_view")
    column = _node(nodes, "remap", "column", "float")
    _connect(column, "in", "float", "cos_theta")
    _add_range(column, atlas.x, _centres(atlas.columns))
    row = _node(nodes, "remap", "row", "float")
    ET.SubElement(row, "input", {"name": "in", "type": "float", "interfacename": "thickness_scale"})
    _add_range(row, atlas.y, _centres(atlas.rows)[::-1])
    place = _node(nodes, "combine2", "place", "vector2")
    _connect(place, "in1", "float", "column")
    _connect(place, "in2", "float", "row")


def _centres(texels: int) -> tuple[float, float]:
    return 0.5 / texels, 1 - 0.5 / texels


def _add_range(remap: ET.Element, axis: Axis, ends: tuple[float, float]) -> None:
    """Map the ends of an axis to `ends`; an axis of one value has equal rows, and any place between them."""
    first, last = float(axis.texels[0]), float(axis.texels[-1])
    low, high = (first, last) if first < last else (first, first + 1)
    bounds = {"inlow": low, "inhigh": high, "outlow": ends[0], "outhigh": ends[1]}
    for name, value in bounds.items():
        _value(remap, name, "float", repr(value))


def _add_texture(nodes: ET.Element, side: str) -> None:
    image = _node(nodes, "image", f"{side}_texture", "color3")
    ET.SubElement(image, "input", {"name": "file", "type": "filename", "interfacename": _file(side)})
    _connect(image, "texcoord", "vector2", "place")
    for name, value in {"uaddressmode": "clamp", "vaddressmode": "clamp", "filtertype": "linear"}.items():
        _value(image, name, "string", value)


def _add_reflection(nodes: ET.Element) -> None:
    lobe = _node(nodes, "generalized_schlick_bsdf", "reflection_bsdf", "BSDF")
    for end in ("color0", "color90"):
        _connect(lobe, end, "color3", f"{_REFLECTION}_texture")
    _add_roughness(lobe)
    _value(lobe, "scatter_mode", "string", "R")


def _add_transmission(nodes: ET.Element) -> None:
    """Let the transmitted colour straight through: between media of one index nothing else is reflected."""
    lobe = _node(nodes, "dielectric_bsdf", "straight_bsdf", "BSDF")
    _value(lobe, "ior", "float", "1")
    _add_roughness(lobe)
    _value(lobe, "scatter_mode", "string", "T")
    tinted = _node(nodes, "multiply", "transmission_bsdf", "BSDF")
    _connect(tinted, "in1", "BSDF", "straight_bsdf")
    _connect(tinted, "in2", "color3", f"{_TRANSMISSION}_texture")
    both = _node(nodes, "add", "both_bsdf", "BSDF")
    _connect(both, "in1", "BSDF", "reflection_bsdf")
    _connect(both, "in2", "BSDF", "transmission_bsdf")


def _add_outputs(nodes: ET.Element, graph: FilmGraph) -> None:
    for side in graph.files:
        _output(nodes, side, "color3", f"{side}_texture")
    _output(nodes, "bsdf", "BSDF", "both_bsdf" if _TRANSMISSION in graph.files else "reflection_bsdf")


# ---- elements ----------------------------------------------------------------------------------------------


def _file(side: str) -> str:
    return f"{side}_file"


def _node(parent: ET.Element, category: str, name: str, kind: str) -> ET.Element:
    return ET.SubElement(parent, category, {"name": name, "type": kind})


def _value(parent: ET.Element, name: str, kind: str, value: str) -> ET.Element:
    return ET.SubElement(parent, "input", {"name": name, "type": kind, "value": value})


def _connect(node: ET.Element, name: str, kind: str, source: str) -> None:
    ET.SubElement(node, "input", {"name": name, "type": kind, "nodename": source})


def _output(nodes: ET.Element, name: str, kind: str, source: str) -> None:
    ET.SubElement(nodes, "output", {"name": name, "type": kind, "nodename": source})


def _add_roughness(lobe: ET.Element) -> None:
    ET.SubElement(lobe, "input", {"name": "roughness", "type": "vector2", "interfacename": "roughness"})
