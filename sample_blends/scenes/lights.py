# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps and worlds, in Blender's units."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from bpy.types import Image, Light, Object

from . import stage

WHITE = (1.0, 1.0, 1.0)


def _lamp(kind: str, name: str, power: float, color: stage.Color) -> Light:
    data = bpy.data.lights.new(name, kind)
    data.energy, data.color = power, color
    return data


def point_lamp(at: stage.Point, watts: float, radius: float) -> Object:
    """A glowing ball of `radius` metres."""
    data = _lamp("POINT", "Point", watts, WHITE)
    data.shadow_soft_size = radius
    return stage.place(data, at)


def area_lamp(at: stage.Point, target: stage.Point, watts: float, size: tuple[float, float],
              color: stage.Color = WHITE, name: str = "Area") -> Object:
    """A glowing rectangle of `size` metres that faces `target`."""
    data = _lamp("AREA", name, watts, color)
    data.shape, (data.size, data.size_y) = "RECTANGLE", size
    return stage.aim(stage.place(data, at), target)


def sun_lamp(direction: stage.Point, strength: float, color: stage.Color) -> Object:
    """A sun that shines along `direction`: W m^-2 on a surface that faces it, as wide as the real one."""
    return stage.aim(stage.place(_lamp("SUN", "Sun", strength, color)), direction)


def world_color(color: stage.Color, strength: float = 1.0) -> Any:
    """A world of one colour in place of the one before; returns its Background node."""
    scene = bpy.context.scene
    if scene.world is not None:
        bpy.data.worlds.remove(scene.world)
    scene.world = bpy.data.worlds.new("World")
    background = stage.nodes(scene.world)["Background"]
    background.inputs["Color"].default_value = (*color, 1.0)
    background.inputs["Strength"].default_value = strength
    return background


def world_image(image: Image, turn: float) -> None:
    """A world lit by an equirectangular `image`, turned by `turn` radians about Z."""
    background = world_color((0.0, 0.0, 0.0))
    tree = bpy.context.scene.world.node_tree
    coordinates, mapping, texture = (tree.nodes.new(f"ShaderNode{kind}") for kind in
                                     ("TexCoord", "Mapping", "TexEnvironment"))
    mapping.inputs["Rotation"].default_value = (0.0, 0.0, turn)
    texture.image = image
    tree.links.new(coordinates.outputs["Generated"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
    tree.links.new(texture.outputs["Color"], background.inputs["Color"])
    for column, node in enumerate((coordinates, mapping, texture)):
        node.location = (-900 + 280 * column, 300)


def packed_image(name: str, width: int, height: int, pixels: np.ndarray) -> Image:
    """`pixels` (width * height * 4,) f4, scene-linear RGBA, row 0 at the bottom, kept inside the .blend."""
    image = bpy.data.images.new(name, width, height, alpha=False, float_buffer=True)
    image.pixels.foreach_set(pixels)
    image.pack()
    return image
