# SPDX-License-Identifier: GPL-3.0-or-later
"""What a point is: attributes, coordinates, geometry, objects."""

from __future__ import annotations

import numpy as np

from ..expr import Expr, as_vector
from ..reader import Reader
from . import Outputs, kind

# Types whose values instances have, under names that begin with them
_LOOKED_UP = ("OBJECT", "INSTANCER", "VIEW_LAYER")


@kind("ShaderNodeAttribute")
def attribute(n: Reader) -> Outputs:
    """An attribute by its name."""
    name = str(n.setting("attribute_name", ""))
    where = n.setting("attribute_type", "GEOMETRY")
    if where == "GEOMETRY" and name == "generated":
        made = n.generated()
        return {"Color": made, "Vector": made, "Fac": made, "Alpha": n.value(1.0)}
    number = n.attribute(f"{where.lower()}:{name}" if where in _LOOKED_UP else name)
    color = n.call("attribute_vector", number)
    return {"Color": color, "Vector": as_vector(color), "Fac": n.call("attribute_factor", number),
            "Alpha": n.call("attribute_alpha", number)}


@kind("ShaderNodeVertexColor")
def vertex_color(n: Reader) -> Outputs:
    """A colour attribute; without a name the active one."""
    number = n.attribute(("color", str(n.setting("layer_name", ""))))
    return {"Color": n.call("attribute_vector", number), "Alpha": n.call("color_attribute_alpha", number)}


@kind("ShaderNodeUVMap")
def uv_map(n: Reader) -> Outputs:
    """A UV map; without a name the active one."""
    if n.setting("from_instancer", False):
        return {"UV": as_vector(n.call("uv_of_instancer"))}
    return {"UV": uv_of(n, str(n.setting("uv_map", "")))}


def uv_of(n: Reader, name: str = "") -> Expr:
    """The coordinates of a UV map."""
    return as_vector(n.call("attribute_vector", n.attribute(("uv", name))))


@kind("ShaderNodeTexCoord")
def texture_coordinate(n: Reader) -> Outputs:
    """Coordinates of all kinds."""
    is_from_instancer = bool(n.setting("from_instancer", False))
    made = {
        "Generated": n.call("generated_of_instancer") if is_from_instancer else n.generated(),
        "UV": n.call("uv_of_instancer") if is_from_instancer else uv_of(n),
        "Normal": n.call("normal_in_object"), "Object": _in_object(n), "Camera": n.call("position_in_camera"),
        "Window": n.call("position_in_window"), "Reflection": n.call("reflected_direction")}
    return {name: as_vector(expr) for name, expr in made.items()}


def _in_object(n: Reader) -> Expr:
    """The point in the object's own space, or in that of the object that the node names."""
    matrix = n.setting("object.matrix_world")
    if not n.setting("object") or matrix is None:
        return n.call("position_in_object")
    try:
        inverse = np.linalg.inv(np.reshape(matrix, (4, 4)))
    except np.linalg.LinAlgError:
        inverse = np.zeros((4, 4))
    rows = (part for row in inverse[:3] for part in (n.value(tuple(row[:3])), n.value(row[3])))
    return n.call("position_in_other", *rows)


@kind("ShaderNodeNewGeometry")
def geometry(n: Reader) -> Outputs:
    """The point's place and directions."""
    vectors = {"Position": "position_of_point", "Normal": "normal_of_point", "True Normal": "true_normal_of_point",
               "Incoming": "incoming_of_point", "Parametric": "parametric_of_point"}
    made: dict[str, Expr] = {name: as_vector(n.call(function)) for name, function in vectors.items()}
    made["Tangent"] = as_vector(n.call("radial_tangent", n.literal(2)))
    made["Backfacing"] = n.call("backfacing_of_point")
    made["Pointiness"] = n.call("attribute_number", n.attribute(("pointiness", "")))
    made["Random Per Island"] = n.call("attribute_number", n.attribute(("island", "")))
    return made


@kind("ShaderNodeTangent")
def tangent(n: Reader) -> Outputs:
    """Around an axis, or along u."""
    if n.setting("direction_type", "RADIAL") == "UV_MAP":
        made = n.call("uv_tangent", n.attribute(("tangent", str(n.setting("uv_map", "")))))
    else:
        made = n.call("radial_tangent", n.literal("XYZ".index(n.setting("axis", "Z"))))
    return {"Tangent": as_vector(made)}


@kind("ShaderNodeObjectInfo")
def object_info(n: Reader) -> Outputs:
    """The object that the surface belongs to."""
    return {"Location": as_vector(n.call("object_origin")), "Color": n.call("object_color"),
            "Alpha": n.call("object_alpha"), "Object Index": n.call("object_number"),
            "Material Index": n.call("material_number"), "Random": n.call("object_random")}


@kind("ShaderNodeCameraData")
def camera_data(n: Reader) -> Outputs:
    """The point as the camera sees it."""
    return {"View Vector": as_vector(n.call("view_vector")), "View Z Depth": n.call("view_depth"),
            "View Distance": n.call("view_distance")}


def normal_of(n: Reader, identifier: str = "Normal") -> Expr:
    """The input, or the point's own normal."""
    return n.vector(identifier, lambda: n.call("normal_of_point"))


@kind("ShaderNodeFresnel")
def fresnel(n: Reader) -> Outputs:
    """What a smooth dielectric mirrors."""
    return {"Fac": n.call("fresnel", n.number("IOR", 1.45), normal_of(n))}


@kind("ShaderNodeLayerWeight")
def layer_weight(n: Reader) -> Outputs:
    """Weights that depend on the angle."""
    blend, normal = n.number("Blend", 0.5), normal_of(n)
    return {"Fresnel": n.call("layer_fresnel", blend, normal), "Facing": n.call("layer_facing", blend, normal)}
