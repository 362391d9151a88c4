# SPDX-License-Identifier: GPL-3.0-or-later
"""What nodes on cards are fed with: patterns that vary over the card, within a range that makes sense for a socket."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np

# Shown elsewhere, or nothing to show
NOT_SHOWN = {"ShaderNodeGroup", "ShaderNodeCustomGroup", "ShaderNodeOutputLineStyle", "ShaderNodeUVAlongStroke",
             "ShaderNodeHairInfo", "ShaderNodePointInfo", "ShaderNodeVolumeInfo", "ShaderNodeVolumeAbsorption",
             "ShaderNodeVolumeScatter", "ShaderNodeVolumePrincipled", "ShaderNodeVolumeCoefficients"}

# Settings that another setting needs to have an effect
BASE: dict[tuple[str, str], dict[str, Any]] = {
    ("ShaderNodeMix", "factor_mode"): {"data_type": "VECTOR"},
    ("ShaderNodeMix", "clamp_factor"): {"data_type": "RGBA"},
    ("ShaderNodeMix", "clamp_result"): {"data_type": "RGBA", "blend_type": "ADD"},
    ("ShaderNodeTexWave", "rings_direction"): {"wave_type": "RINGS"},
    ("ShaderNodeTexVoronoi", "distance"): {"voronoi_dimensions": "3D", "feature": "F1"},
    ("ShaderNodeTexImage", "projection_blend"): {"projection": "BOX"},
    ("ShaderNodeTangent", "uv_map"): {"direction_type": "UV_MAP"},
    ("ShaderNodeTangent", "axis"): {"direction_type": "RADIAL"},
}

# By kind and input: a constant, or (lowest, highest) over the card; None leaves it as it is
VALUES: dict[tuple[str, str], Any] = {
    ("ShaderNodeBlackbody", "Temperature"): (900, 12500), ("ShaderNodeWavelength", "Wavelength"): (370, 790),
    ("ShaderNodeGamma", "Gamma"): (0.2, 3), ("ShaderNodeHueSaturation", "Hue"): (0, 1),
    ("ShaderNodeHueSaturation", "Saturation"): 1.4, ("ShaderNodeHueSaturation", "Fac"): 0.8,
    ("ShaderNodeFresnel", "IOR"): (0.8, 2.5), ("ShaderNodeLayerWeight", "Blend"): (0.05, 0.95),
    ("ShaderNodeTexNoise", "Detail"): 3.5, ("ShaderNodeTexNoise", "Roughness"): 0.6,
    ("ShaderNodeTexNoise", "Lacunarity"): 2.1, ("ShaderNodeTexNoise", "Distortion"): 0.4,
    ("ShaderNodeTexVoronoi", "Randomness"): 0.8, ("ShaderNodeTexVoronoi", "Exponent"): 1.5,
    ("ShaderNodeTexVoronoi", "Smoothness"): 0.6, ("ShaderNodeTexVoronoi", "Detail"): 1.5,
    ("ShaderNodeTexWave", "Distortion"): 1.5, ("ShaderNodeTexWave", "Detail"): 2.5,
    ("ShaderNodeTexBrick", "Mortar Smooth"): 0.5, ("ShaderNodeTexBrick", "Bias"): 0.2,
    ("ShaderNodeVectorRotate", "Angle"): (-3, 3), ("ShaderNodeMapping", "Rotation"): (0.3, 0.5, 0.7),
    ("ShaderNodeMapping", "Scale"): (1.5, 0.7, 2.0), ("ShaderNodeMapping", "Location"): (0.1, 0.2, 0.3),
    ("ShaderNodeBump", "Distance"): 0.3, ("ShaderNodeBump", "Height"): (0, 1),
    ("ShaderNodeNormalMap", "Strength"): 0.7, ("ShaderNodeSqueeze", "Width"): 2.0,
}
TEXTURES = "ShaderNodeTex"
STEPPED = {"ShaderNodeTexWhiteNoise"}  # kinds for which a last bit is another world
INPUTS_LEFT = ("Tangent", "Coat Normal", "Thickness")

Nodes = Any


def feed(nodes: Nodes, node: Any) -> None:
    """Link or set all inputs of `node`, and give it what it names."""
    _name(node)
    is_texture = node.bl_idname.startswith(TEXTURES) or node.bl_idname.startswith("ShaderNodeBsdf")
    for number, socket in enumerate(s for s in node.inputs if not s.is_unavailable):
        value = VALUES.get((node.bl_idname, socket.identifier))
        if value is not None:
            _give(nodes, socket, value, number)
        elif socket.type == "VALUE" and not is_texture:
            _give(nodes, socket, _range_of(socket), number)
        elif socket.type == "VALUE" and socket.identifier == "W":
            _give(nodes, socket, (0.3, 1.7), number)
        elif socket.type == "RGBA":
            nodes.tree.links.new(color(nodes, number), socket)
        elif socket.type == "VECTOR" and socket.identifier not in ("Normal", *INPUTS_LEFT):
            nodes.tree.links.new(vector(nodes, number), socket)
    if node.bl_idname in STEPPED:
        for link in [socket.links[0] for socket in node.inputs if socket.is_linked]:
            nodes.tree.links.new(_stepped(nodes, link.from_socket), link.to_socket)


def _stepped(nodes: Nodes, socket: Any) -> Any:
    """The same in steps that are powers of two."""
    kind, step = ("VectorMath", (0.125,) * 3) if socket.type == "VECTOR" else ("Math", 0.125)
    node = nodes.new(kind)
    node.operation = "SNAP"
    nodes.tree.links.new(socket, node.inputs[0])
    node.inputs[1].default_value = step
    return node.outputs[0]


def _range_of(socket: Any) -> tuple[float, float]:
    name = socket.name
    if name in ("Factor", "Fac", "Red", "Green", "Blue", "Hue", "Saturation", "Lightness", "Alpha", "Facing"):
        return 0.0, 1.0
    return -1.6, 2.1


def _give(nodes: Nodes, socket: Any, value: Any, number: int) -> None:
    if socket.type == "VALUE" and isinstance(value, tuple):
        low, high = value
        nodes.tree.links.new(ramp(nodes, number, low, high), socket)
    else:
        socket.default_value = value


def ramp(nodes: Nodes, number: int, low: float, high: float) -> Any:
    """A number from `low` to `high` over the card: along u, along v, or slantwise."""
    u, v = _uv(nodes)
    node = nodes.new("Math")
    node.operation = "MULTIPLY_ADD"
    if number % 3 == 2:
        both = nodes.new("Math", Value=u, Value_001=v)
        both.operation = "MULTIPLY"
        nodes.tree.links.new(both.outputs[0], node.inputs[0])
    else:
        nodes.tree.links.new((u, v)[number % 3], node.inputs[0])
    node.inputs[1].default_value, node.inputs[2].default_value = high - low, low
    return node.outputs[0]


def vector(nodes: Nodes, number: int) -> Any:
    """Three numbers that vary over the card, none of them symmetric."""
    parts = {"X": (-1.3, 1.6), "Y": (-0.9, 1.9), "Z": (0.35, 0.85)}
    node = nodes.new("CombineXYZ")
    for i, (name, (low, high)) in enumerate(parts.items()):
        nodes.tree.links.new(ramp(nodes, i + number, low, high), node.inputs[name])
    return node.outputs[0]


def color(nodes: Nodes, number: int) -> Any:
    """A colour that varies over the card; one of its channels goes a little past 1."""
    parts = {"Red": (0.05, 1.0), "Green": (0.9, 0.1), "Blue": (0.2, 1.15)}
    node = nodes.new("CombineColor")
    for i, (name, (low, high)) in enumerate(parts.items()):
        nodes.tree.links.new(ramp(nodes, i + number, low, high), node.inputs[name])
    return node.outputs[0]


def _uv(nodes: Nodes) -> tuple[Any, Any]:
    """The sockets of u and v, made once a tree."""
    split = nodes.tree.nodes.get("UV of the card")
    if split is None:
        split = nodes.new("SeparateXYZ", Vector=nodes.new("TexCoord").outputs["UV"])
        split.name = "UV of the card"
    return split.outputs["X"], split.outputs["Y"]


def _name(node: Any) -> None:
    """Give a node the attribute, image or curve that it is of no use without."""
    names: dict[str, Callable[[], None]] = {
        "ShaderNodeAttribute": lambda: setattr(node, "attribute_name", "tint"),
        "ShaderNodeVertexColor": lambda: setattr(node, "layer_name", "paint"),
        "ShaderNodeTexImage": lambda: setattr(node, "image", picture()),
        "ShaderNodeTexEnvironment": lambda: setattr(node, "image", picture()),
        "ShaderNodeValToRGB": lambda: _bend_ramp(node), "ShaderNodeRGBCurve": lambda: _bend(node, 3),
        "ShaderNodeVectorCurve": lambda: _bend(node, 0), "ShaderNodeFloatCurve": lambda: _bend(node, 0),
        "ShaderNodeRGB": lambda: setattr(node.outputs[0], "default_value", (0.2, 0.5, 0.8, 1)),
        "ShaderNodeValue": lambda: setattr(node.outputs[0], "default_value", 0.7),
        "ShaderNodeNormal": lambda: setattr(node.outputs[0], "default_value", (0.48, 0.6, 0.64)),
    }
    names.get(node.bl_idname, lambda: None)()


def _bend_ramp(node: Any) -> None:
    elements = node.color_ramp.elements
    elements[0].color, elements[0].position = (0.8, 0.1, 0.2, 0.3), 0.1
    elements.new(0.45).color = (0.1, 0.7, 0.3, 1)


def _bend(node: Any, curve: int) -> None:
    node.mapping.curves[curve].points.new(0.3, 0.6)
    node.mapping.update()


def picture() -> Any:
    """An image of 16 by 8 texels."""
    made = bpy.data.images.get("Picture")
    if made is None:
        made = bpy.data.images.new("Picture", 16, 8, alpha=True)
        y, x = np.mgrid[0:8, 0:16]
        pixels = np.stack([(x * 37 % 16) / 15, y / 7, (x + y) % 5 / 4, np.ones((8, 16))], 2)
        made.pixels.foreach_set(pixels.astype("f4").ravel())
        made.pack()
    return made


def dress(owner: Any, number: int) -> None:
    """Give the object of a card what nodes ask of one: attributes, a colour, an index, a property."""
    mesh = owner.data
    owner.color, owner.pass_index, owner["tint"] = (0.2, 0.4, 0.6, 0.8), 3, 0.3
    tint = mesh.attributes.new("tint", "FLOAT_VECTOR", "POINT")
    tint.data.foreach_set("vector", np.linspace(0.1, 0.9, 12).astype("f4"))
    paint = mesh.color_attributes.new("paint", "BYTE_COLOR", "CORNER")
    paint.data.foreach_set("color", np.linspace(0, 1, 16).astype("f4"))
    owner.data.materials[0].pass_index = number
