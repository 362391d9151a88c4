# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of normals, and what lifts surfaces."""

from __future__ import annotations

from ..expr import as_vector
from ..reader import Reader
from . import Outputs, kind
from .inputs import normal_of

_FLAT = (0.5, 0.5, 1.0)


@kind("ShaderNodeNormalMap")
def normal_map(n: Reader) -> Outputs:
    """Normals as colours."""
    color, strength, space = n.color("Color", _FLAT), n.number("Strength", 1.0), n.setting("space", "TANGENT")
    if space == "TANGENT":
        tangents = n.attribute(("tangent", str(n.setting("uv_map", ""))))
        made = n.call("normal_map_tangent", color, strength, tangents)
    else:
        made = n.call("normal_map_space", color, strength, n.literal("OBJECT" in space),
                      n.literal(space.startswith("BLENDER")))
    return {"Normal": as_vector(made)}


@kind("ShaderNodeBump")
def bump(n: Reader) -> Outputs:
    """The normals of a surface of some height, by its height in three places."""
    normal = normal_of(n)
    if not n.is_linked("Height"):
        return {"Normal": normal}
    width = n.node.inputs.get("Filter Width")
    width = float(width) if isinstance(width, (int, float)) else (0.1 if n.has("Filter Width") else 1.0)
    height, distance = n.number("Height"), n.number("Distance", 1.0)
    if n.setting("invert", False):
        distance = n.call("math_multiply", distance, n.value(-1.0))
    places = n.heights(height, max(width, 1e-3))
    made = n.call("bumped_normal", places["x"], places["y"], places["z"], normal, n.number("Strength", 1.0), distance,
                  n.literal(max(width, 1e-3)))
    return {"Normal": as_vector(made)}


@kind("ShaderNodeDisplacement")
def displacement(n: Reader) -> Outputs:
    """Along the normal."""
    is_of_object = n.literal(n.setting("space", "OBJECT") == "OBJECT")
    made = n.call("displaced", n.number("Height"), n.number("Midlevel", 0.5), n.number("Scale", 1.0), normal_of(n),
                  is_of_object)
    return {"Displacement": as_vector(made)}


@kind("ShaderNodeVectorDisplacement")
def vector_displacement(n: Reader) -> Outputs:
    """In any direction."""
    by, midlevel, scale = n.vector("Vector"), n.number("Midlevel"), n.number("Scale", 1.0)
    space = n.setting("space", "TANGENT")
    if space == "TANGENT":
        made = n.call("displaced_in_tangent_space", by, midlevel, scale, n.attribute(("tangent", "")))
    else:
        made = n.call("displaced_by_vector", by, midlevel, scale, n.literal(space == "OBJECT"))
    return {"Displacement": as_vector(made)}
