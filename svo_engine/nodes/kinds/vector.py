# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes that turn and move vectors."""

from __future__ import annotations

from ..expr import Expr, as_vector
from ..reader import Reader
from . import Outputs, kind
from .curves import curved

_AXES = {"X_AXIS": (1.0, 0.0, 0.0), "Y_AXIS": (0.0, 1.0, 0.0), "Z_AXIS": (0.0, 0.0, 1.0)}


@kind("ShaderNodeMapping")
def mapping(n: Reader) -> Outputs:
    """Scale, rotation and location."""
    way = n.setting("vector_type", "POINT").lower()
    location = [n.vector("Location")] if way in ("point", "texture") else []
    columns = _euler(n, n.vector("Rotation"))
    made = n.call(f"mapping_{way}", n.vector("Vector"), *location, n.vector("Scale", (1.0, 1.0, 1.0)), *columns)
    return {"Vector": as_vector(made)}


@kind("ShaderNodeVectorRotate")
def vector_rotate(n: Reader) -> Outputs:
    """A rotation about a centre."""
    way, invert = n.setting("rotation_type", "AXIS_ANGLE"), n.setting("invert", False)
    v, center = n.vector("Vector"), n.vector("Center")
    if way == "EULER_XYZ":
        columns = _euler(n, n.vector("Rotation"))
        function = "rotated_back_by_columns" if invert else "rotated_by_columns"
        return {"Vector": as_vector(n.call(function, v, center, *columns))}
    axis = n.literal(_AXES[way]) if way in _AXES else n.vector("Axis")
    angle = n.number("Angle")
    if invert:
        angle = n.call("math_subtract", n.literal(0.0), angle)
    return {"Vector": as_vector(n.call("rotated_by_angle", v, center, axis, angle))}


def _euler(n: Reader, rotation: Expr) -> list[Expr]:
    """The columns of a rotation by three angles."""
    return [n.call(f"euler_{axis}", rotation) for axis in "xyz"]


@kind("ShaderNodeNormal")
def normal(n: Reader) -> Outputs:
    """A direction, and the cosine between it and another one."""
    direction = n.call("vector_normalize", n.value(n.setting("value", (0.0, 0.0, 1.0))[:3]))
    return {"Normal": as_vector(direction), "Dot": n.call("cosine_between", direction, n.vector("Normal"))}


@kind("ShaderNodeVectorCurve")
def vector_curves(n: Reader) -> Outputs:
    """A curve for each part of a vector."""
    return {"Vector": as_vector(curved(n, n.number("Fac", 1.0), n.vector("Vector"), 3))}


@kind("ShaderNodeVectorTransform")
def vector_transform(n: Reader) -> Outputs:
    """From one space to another, by way of the world."""
    what = n.setting("vector_type", "VECTOR").lower()
    start, end = (n.setting(f"convert_{way}", "WORLD").lower() for way in ("from", "to"))
    made = n.vector("Vector")
    if start != end:
        made = made if start == "world" else n.call(f"{what}_world_from_{start}", made)
        made = made if end == "world" else n.call(f"{what}_{end}_from_world", made)
    return {"Vector": as_vector(made)}


@kind("ShaderNodeRadialTiling")
def radial_tiling(n: Reader) -> Outputs:
    """The plane in segments around 0."""
    sides, roundness = n.number("Sides", 5.0), n.number("Roundness")
    made = n.call("radial_tiling", n.vector("Vector"), sides, roundness, n.literal(bool(n.setting("normalize", False))))
    return {"Segment Coordinates": as_vector(made["coordinates"]), "Segment ID": made["id"],
            "Segment Width": made["width"], "Segment Rotation": made["rotation"]}
