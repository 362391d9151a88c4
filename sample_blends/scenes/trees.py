# SPDX-License-Identifier: GPL-3.0-or-later
"""Short ways to make node trees that all supported versions of Blender have."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.types import Material, Node, NodeSocket

from . import stage

Stop = tuple[float, tuple[float, float, float]]


class Tree:
    """The nodes of a new material, at first nothing but its output.

    An input takes a constant, a colour of three numbers, a socket, or a node, of which the first output in use counts.
    """

    def __init__(self, name: str) -> None:
        self.material: Material = bpy.data.materials.new(name)
        stage.nodes(self.material).clear()
        self.nodes, self.links = self.material.node_tree.nodes, self.material.node_tree.links
        self._output = self.new("OutputMaterial")

    def new(self, kind: str, settings: dict[str, Any] | None = None, **inputs: Any) -> Node:
        """A node of `ShaderNode<kind>`; inputs by identifier, underscores for blanks."""
        node = self.nodes.new(f"ShaderNode{kind}")
        node.location = 220 * (len(self.nodes) - 12), 0
        for name, value in (settings or {}).items():
            setattr(node, name, value)
        for name, value in inputs.items():
            self.feed(node, name, value)
        return node

    def feed(self, node: Node, name: str, value: Any) -> None:
        """Link or set an input."""
        socket = next(s for s in node.inputs if s.identifier in (name, name.replace("_", " ")))
        if isinstance(value, (Node, NodeSocket)):
            self.links.new(value if isinstance(value, NodeSocket) else first(value), socket)
        elif socket.type == "RGBA":
            socket.default_value = (*value, 1.0)
        else:
            socket.default_value = value

    def show(self, surface: Node) -> Material:
        """Make `surface` the material's."""
        self.feed(self._output, "Surface", surface)
        return self.material

    def at(self, output: str = "Object", **mapped: Any) -> Node | NodeSocket:
        """Coordinates, turned or scaled by a Mapping node if there are inputs for one."""
        socket = output_of(self.new("TexCoord"), output)
        return self.new("Mapping", Vector=socket, **mapped) if mapped else socket

    def ramp(self, factor: Any, *stops: Stop, interpolation: str = "LINEAR") -> Node:
        """A Color Ramp with those stops."""
        node = self.new("ValToRGB", Fac=factor)
        node.color_ramp.interpolation = interpolation
        elements = node.color_ramp.elements
        while len(elements) < len(stops):
            elements.new(1.0)
        for element, (position, color) in zip(elements, stops, strict=True):
            element.position, element.color = position, (*color, 1.0)
        return node

    def math(self, operation: str, *values: Any) -> Node:
        """A Math node."""
        node = self.new("Math", {"operation": operation})
        for identifier, value in zip(("Value", "Value_001", "Value_002"), values, strict=False):
            self.feed(node, identifier, value)
        return node

    def mix(self, factor: Any, a: Any, b: Any, blend: str = "MIX") -> Node:
        """A Mix node of two colours."""
        return self.new("Mix", {"data_type": "RGBA", "blend_type": blend}, Factor_Float=factor, A_Color=a, B_Color=b)

    def blend(self, factor: Any, a: Node, b: Node) -> Node:
        """A Mix Shader."""
        return self.new("MixShader", Fac=factor, Shader=a, Shader_001=b)

    def bump(self, height: Any, distance: float, strength: float = 1.0) -> Node:
        """A Bump node; `distance` in metres."""
        return self.new("Bump", Height=height, Distance=distance, Strength=strength)


def first(node: Node) -> NodeSocket:
    """The first output that the node's settings leave in use."""
    return next(s for s in node.outputs if s.enabled)


def output_of(node: Node, identifier: str) -> NodeSocket:
    """The output of that identifier."""
    return next(s for s in node.outputs if s.identifier == identifier)
