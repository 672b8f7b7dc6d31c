"""The node group of a film: its colour at every pixel, and a surface of that colour.

The cosine is that of the angle between the normal and the view direction. Where a film lies on a refracting
solid and is met from inside, Snell's law gives the cosine outside, on which the table is laid out; R and T of
a film that does not absorb are the same from both sides (Born and Wolf, 1.6.2), and beyond the critical angle
the cosine is 0, where the table holds R = 1 and T = 0.
"""

from collections.abc import Callable
from dataclasses import dataclass

import bpy

from .lookup_texture import Axis, LookupTexture
from .node_graph import Graph

Socket = bpy.types.NodeSocket
Reader = Callable[["Film"], tuple[Socket, Socket | None]]
"""What reads the colours of R and T in a group: `image_reader.read` or `osl_reader.read`."""


@dataclass(frozen=True)
class Film:
    """What a reader finds in the group.

    Parameters
    ----------
    graph : Graph
    texture : LookupTexture
    cos_theta, thickness_scale : bpy.types.NodeSocket
        Where to read.
    """

    graph: Graph
    texture: LookupTexture
    cos_theta: Socket
    thickness_scale: Socket


def film_group(texture: LookupTexture, read: Reader) -> bpy.types.ShaderNodeTree:
    """Return a new node group with the sockets that `declare_sockets` lists."""
    tree = bpy.data.node_groups.new(f"Nacreous {texture.label}", "ShaderNodeTree")
    declare_sockets(tree, texture)
    graph = Graph(tree)
    given = graph.node("NodeGroupInput").outputs
    normal = _normal(graph, given["Normal"])
    cos_theta = _cosine(graph, normal, texture, given)
    R, T = read(Film(graph, texture, cos_theta, given["Thickness Scale"]))
    results = graph.node("NodeGroupOutput").inputs
    graph.connect(_surface(graph, texture, given, normal, R, T), results["BSDF"])
    graph.connect(R, results["R"])
    if T is not None:
        graph.connect(T, results["T"])
    graph.connect(cos_theta, results["Cos Theta"])
    graph.arrange()
    return tree


def declare_sockets(tree: bpy.types.ShaderNodeTree, texture: LookupTexture) -> None:
    """Give the group its inputs and outputs; only what refracts has an IOR, only what transmits a T."""
    _input(tree, "Thickness Scale", _middle(texture.rows), "Factor on the thickness of every layer")
    _input(tree, "Roughness", 0.0, "Of the surface: the square root of GGX's alpha", most=1.0)
    if _refracts(texture):
        _input(tree, "IOR", texture.substrate_ior, "Index of what lies under the film")
    normal = tree.interface.new_socket("Normal", in_out="INPUT", socket_type="NodeSocketVector")
    normal.description, normal.hide_value = "The surface's own unless connected", True
    outputs = {"BSDF": "Shader", "R": "Color", "T": "Color", "Cos Theta": "Float"}
    for name, kind in outputs.items():
        if name != "T" or texture.transmission_path:
            tree.interface.new_socket(name, in_out="OUTPUT", socket_type=f"NodeSocket{kind}")


def _input(
    tree: bpy.types.ShaderNodeTree, name: str, default: float, description: str, most: float = 10.0
) -> None:
    socket = tree.interface.new_socket(name, in_out="INPUT", socket_type="NodeSocketFloat")
    socket.min_value, socket.max_value = 0.0, most
    socket.default_value, socket.description = default, description


def _middle(axis: Axis) -> float:
    """Return a thickness to begin with: that of the film itself, or the nearest in the table."""
    return min(max(1.0, axis.values[0]), axis.values[-1])


def _refracts(texture: LookupTexture) -> bool:
    return texture.transmission_path is not None and not texture.is_free_standing


def _normal(graph: Graph, given: Socket) -> Socket:
    """Choose the normal that is given, or the surface's own: an unconnected socket has no length."""
    own = graph.node("ShaderNodeNewGeometry").outputs["Normal"]
    return graph.choose("VECTOR", graph.math("GREATER_THAN", graph.length(given), 0.5), own, given)


def _cosine(graph: Graph, normal: Socket, texture: LookupTexture, given: bpy.types.NodeOutputs) -> Socket:
    """Return the cosine of the angle in the incident medium."""
    geometry = graph.node("ShaderNodeNewGeometry").outputs
    seen = graph.math("ABSOLUTE", graph.dot(normal, geometry["Incoming"]))
    if not _refracts(texture):
        return seen
    return graph.choose("FLOAT", geometry["Backfacing"], seen, _cosine_outside(graph, seen, given["IOR"]))


def _cosine_outside(graph: Graph, cos_inside: Socket, ior: Socket) -> Socket:
    """Snell's law: cos² outside = 1 - n² (1 - cos² inside), held at 0 beyond the critical angle."""
    sin2_inside = graph.math("SUBTRACT", 1.0, graph.math("POWER", cos_inside, 2.0))
    sin2 = graph.math("MULTIPLY", graph.math("POWER", ior, 2.0), sin2_inside)
    return graph.math("SQRT", graph.math("MAXIMUM", graph.math("SUBTRACT", 1.0, sin2), 0.0))


def _surface(
    graph: Graph,
    texture: LookupTexture,
    given: bpy.types.NodeOutputs,
    normal: Socket,
    R: Socket,
    T: Socket | None,
) -> Socket:
    """Add a glossy surface of colour R, and behind it what T lets through."""
    # GGX without the light that facets pass on to each other, as in Nacreous' own tables of rough surfaces
    glossy = graph.node("ShaderNodeBsdfAnisotropic", distribution="GGX")
    _wire(graph, glossy, Color=R, Roughness=given["Roughness"], Normal=normal)
    if T is None:
        return glossy.outputs["BSDF"]
    both = graph.node("ShaderNodeAddShader")
    graph.connect(glossy.outputs["BSDF"], both.inputs[0])
    graph.connect(_behind(graph, texture, given, normal, T), both.inputs[1])
    return both.outputs["Shader"]


def _behind(
    graph: Graph, texture: LookupTexture, given: bpy.types.NodeOutputs, normal: Socket, T: Socket
) -> Socket:
    """Let light pass straight on, or refract it into the substrate."""
    if texture.is_free_standing:
        straight = graph.node("ShaderNodeBsdfTransparent")
        _wire(graph, straight, Color=T)
        return straight.outputs["BSDF"]
    refracted = graph.node("ShaderNodeBsdfRefraction", distribution="GGX")
    _wire(graph, refracted, Color=T, Roughness=given["Roughness"], IOR=given["IOR"], Normal=normal)
    return refracted.outputs["BSDF"]


def _wire(graph: Graph, node: bpy.types.Node, **operands: Socket) -> None:
    for name, operand in operands.items():
        graph.connect(operand, node.inputs[name])
