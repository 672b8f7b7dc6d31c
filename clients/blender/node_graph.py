"""A few words to write a node tree with, and to lay it out so that it can be read."""

from typing import Any

import bpy

Operand = bpy.types.NodeSocket | float
COLUMN_WIDTH = 200
ROW_HEIGHT = 190


class Graph:
    """A node tree that is being written.

    Parameters
    ----------
    tree : bpy.types.NodeTree
    """

    def __init__(self, tree: bpy.types.NodeTree) -> None:
        self.tree = tree

    def node(self, kind: str, **properties: Any) -> bpy.types.Node:  # noqa: ANN401 - of any type
        """Add a node and set its properties."""
        node = self.tree.nodes.new(kind)
        for name, value in properties.items():
            setattr(node, name, value)
        return node

    def connect(self, operand: Operand, socket: bpy.types.NodeSocket) -> None:
        """Link a socket, or set its value."""
        if isinstance(operand, bpy.types.NodeSocket):
            self.tree.links.new(operand, socket)
        else:
            socket.default_value = operand

    def math(self, operation: str, *operands: Operand) -> bpy.types.NodeSocket:
        """Add a Math node and return its result."""
        return self._applied("ShaderNodeMath", operation, operands).outputs["Value"]

    def length(self, vector: bpy.types.NodeSocket) -> bpy.types.NodeSocket:
        """Return the length of a vector."""
        return self._applied("ShaderNodeVectorMath", "LENGTH", (vector,)).outputs["Value"]

    def dot(self, a: bpy.types.NodeSocket, b: bpy.types.NodeSocket) -> bpy.types.NodeSocket:
        """Return the dot product of two vectors."""
        return self._applied("ShaderNodeVectorMath", "DOT_PRODUCT", (a, b)).outputs["Value"]

    def choose(
        self, kind: str, factor: bpy.types.NodeSocket, at_0: bpy.types.NodeSocket, at_1: bpy.types.NodeSocket
    ) -> bpy.types.NodeSocket:
        """Return `at_0` where `factor` is 0, `at_1` where it is 1; `kind` is ``FLOAT`` or ``VECTOR``."""
        mix = self.node("ShaderNodeMix", data_type=kind)
        enabled = [socket for socket in mix.inputs if socket.enabled]
        for operand, socket in zip((factor, at_0, at_1), enabled, strict=True):
            self.connect(operand, socket)
        return next(socket for socket in mix.outputs if socket.enabled)

    def arrange(self) -> None:
        """Place every node to the left of those that it feeds."""
        columns: dict[int, int] = {}
        for node in self.tree.nodes:
            depth = self._depth(node)
            node.location = (-depth * COLUMN_WIDTH, -columns.get(depth, 0) * ROW_HEIGHT)
            columns[depth] = columns.get(depth, 0) + 1

    def _depth(self, node: bpy.types.Node) -> int:
        """Longest way to a node that feeds no other."""
        fed = (link.to_node for socket in node.outputs for link in socket.links)
        return max((1 + self._depth(other) for other in fed), default=0)

    def _applied(self, kind: str, operation: str, operands: tuple[Operand, ...]) -> bpy.types.Node:
        node = self.node(kind, operation=operation)
        for operand, socket in zip(operands, node.inputs, strict=False):
            self.connect(operand, socket)
        return node
