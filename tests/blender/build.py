# SPDX-License-Identifier: GPL-3.0-or-later
"""Small scenes for the tests that read Blender's data, and short ways to make nodes."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from svo_engine.blender.extract import extract


def extracted(**options):
    """The Scene of the open file as its viewport has it."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    depsgraph.update()
    return extract(depsgraph, **options)


def extracted_by_render():
    """The Scene of the open file as a final render has it."""
    found = []

    class Extractor(bpy.types.RenderEngine):
        bl_idname = "EXTRACTOR"
        bl_label = "Extractor"

        def render(self, depsgraph):
            found.append(extract(depsgraph))

    bpy.utils.register_class(Extractor)
    try:
        bpy.context.scene.render.engine = "EXTRACTOR"
        bpy.ops.render.render()
    finally:
        bpy.utils.unregister_class(Extractor)
    return found[0]


def place(data, name="Object", at=(0, 0, 0), turn=(0, 0, 0), scale=(1, 1, 1)):
    """A new object in the open scene."""
    made = bpy.data.objects.new(name, data)
    made.location, made.rotation_euler, made.scale = at, turn, scale
    bpy.context.scene.collection.objects.link(made)
    return made


def plane(*materials, name="Plane", size=2.0, **where):
    """A square in XY around the origin, its UVs from 0 to 1, with the materials in its slots."""
    bpy.ops.mesh.primitive_plane_add(size=size)
    made = bpy.context.object
    made.name = made.data.name = name
    made.location, made.rotation_euler, made.scale = (where.get(k, d) for k, d in (
        ("at", (0, 0, 0)), ("turn", (0, 0, 0)), ("scale", (1, 1, 1))))
    for material in materials:
        made.data.materials.append(material)
    return made


def lamp(kind, at=(0, 0, 0), turn=(0, 0, 0), scale=(1, 1, 1), **settings):
    """A new lamp; `settings` are properties of its data."""
    data = bpy.data.lights.new("Lamp", kind)
    for name, value in settings.items():
        setattr(data, name, value)
    return place(data, "Lamp", at, turn, scale)


def tree_of(owner):
    """The node tree of a new material, world or lamp. Blender 5 makes it at birth, 4 waits for `use_nodes`."""
    if owner.node_tree is None:
        owner.use_nodes = True
    return owner.node_tree


class Nodes:
    """The nodes of a new material, world or lamp, at first nothing but its output."""

    def __init__(self, owner: Any) -> None:
        self.owner = owner
        self.tree = tree_of(owner)
        kind = {"Material": "Material", "World": "World"}.get(type(owner).__name__, "Light")
        self.tree.nodes.clear()
        self.output = self.tree.nodes.new(f"ShaderNodeOutput{kind}")

    def new(self, kind: str, **inputs: Any) -> Any:
        """A node; an input takes a constant, or what another node gives: the node itself (first output) or a socket."""
        node = self.tree.nodes.new(f"ShaderNode{kind}")
        for name, value in inputs.items():
            self.set(node, name.replace("_", " "), value)
        return node

    def set(self, node, name, value):
        socket = next(s for s in node.inputs if s.identifier in (name, name.replace(" ", "_")))
        if isinstance(value, bpy.types.Node):
            value = value.outputs[0]
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value

    def show(self, node: Any, output: str = "Surface") -> Any:
        """Make `node` what the output shows."""
        self.set(self.output, output, node)
        return self.owner


def material(name: str = "Material") -> Nodes:
    """The Nodes of a new material."""
    return Nodes(bpy.data.materials.new(name))


def world(name: str = "World") -> Nodes:
    """The Nodes of a new world, which becomes the scene's."""
    bpy.context.scene.world = bpy.data.worlds.new(name)
    return Nodes(bpy.context.scene.world)


def image(pixels, name="Image", *, space="sRGB", is_float=False, alpha_mode="STRAIGHT"):
    """An image datablock of `pixels` (height, width, 4), row 0 at the bottom."""
    pixels = np.asarray(pixels, "f4")
    made = bpy.data.images.new(name, pixels.shape[1], pixels.shape[0], alpha=True, float_buffer=is_float)
    made.alpha_mode = alpha_mode
    if made.colorspace_settings.name != space and not is_float:
        made.colorspace_settings.name = space
    made.pixels.foreach_set(pixels.ravel())
    made.update()
    return made


def one_color(*rgba, **options):
    """An image of one texel."""
    return image([[rgba]], **options)
