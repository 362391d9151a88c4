# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers and vectors computed: the Math, Vector Math, Map Range and Clamp nodes, and a bare Value."""

from __future__ import annotations

from ..expr import as_vector
from ..reader import Reader
from ..signatures import library
from . import Outputs, kind

_MATH = {
    "ADD": "add", "SUBTRACT": "subtract", "MULTIPLY": "multiply", "DIVIDE": "divide", "MULTIPLY_ADD": "multiply_add",
    "POWER": "power", "LOGARITHM": "logarithm", "SQRT": "square_root", "INVERSE_SQRT": "inverse_square_root",
    "ABSOLUTE": "absolute", "EXPONENT": "exponent", "MINIMUM": "minimum", "MAXIMUM": "maximum",
    "LESS_THAN": "less_than", "GREATER_THAN": "greater_than", "SIGN": "sign", "COMPARE": "compare",
    "SMOOTH_MIN": "smooth_minimum", "SMOOTH_MAX": "smooth_maximum", "ROUND": "round", "FLOOR": "floor", "CEIL": "ceil",
    "TRUNC": "truncate", "FRACT": "fraction", "MODULO": "modulo", "FLOORED_MODULO": "floored_modulo", "WRAP": "wrap",
    "SNAP": "snap", "PINGPONG": "pingpong", "SINE": "sine", "COSINE": "cosine", "TANGENT": "tangent",
    "ARCSINE": "arcsine", "ARCCOSINE": "arccosine", "ARCTANGENT": "arctangent", "ARCTAN2": "arctangent2",
    "SINH": "hyperbolic_sine", "COSH": "hyperbolic_cosine", "TANH": "hyperbolic_tangent", "RADIANS": "radians",
    "DEGREES": "degrees"}
_VECTOR_MATH = {
    "ADD": "add", "SUBTRACT": "subtract", "MULTIPLY": "multiply", "DIVIDE": "divide", "MULTIPLY_ADD": "multiply_add",
    "CROSS_PRODUCT": "cross", "PROJECT": "project", "REFLECT": "reflect", "REFRACT": "refract",
    "FACEFORWARD": "faceforward", "DOT_PRODUCT": "dot", "DISTANCE": "distance", "LENGTH": "length", "SCALE": "scale",
    "NORMALIZE": "normalize", "ABSOLUTE": "absolute", "POWER": "power", "SIGN": "sign", "MINIMUM": "minimum",
    "MAXIMUM": "maximum", "FLOOR": "floor", "CEIL": "ceil", "FRACTION": "fraction", "MODULO": "modulo", "WRAP": "wrap",
    "SNAP": "snap", "SINE": "sine", "COSINE": "cosine", "TANGENT": "tangent"}
_MAP_RANGE = {"LINEAR": "linear", "STEPPED": "stepped", "SMOOTHSTEP": "smooth", "SMOOTHERSTEP": "smoother"}


@kind("ShaderNodeValue")
def value(n: Reader) -> Outputs:
    """A number."""
    return {"Value": n.value(n.setting("value", 0.0))}


@kind("ShaderNodeMath")
def math(n: Reader) -> Outputs:
    """An operation on up to three numbers."""
    operation = n.setting("operation", "ADD")
    if operation not in _MATH:
        n.warn(f"operation {operation} is not known; its first input stands in")
        return {"Value": n.number("Value")}
    function = f"math_{_MATH[operation]}"
    inputs = ("Value", "Value_001", "Value_002")[:len(library()[function].arguments)]
    made = n.call(function, *map(n.number, inputs))
    return {"Value": n.call("math_clamped", made) if n.setting("use_clamp", False) else made}


@kind("ShaderNodeVectorMath")
def vector_math(n: Reader) -> Outputs:
    """An operation on up to three vectors."""
    operation = n.setting("operation", "ADD")
    if operation not in _VECTOR_MATH:
        n.warn(f"operation {operation} is not known; its first input stands in")
        return {"Vector": n.vector("Vector")}
    function = f"vector_{_VECTOR_MATH[operation]}"
    types, vectors = library()[function].arguments, iter(("Vector", "Vector_001", "Vector_002"))
    made = n.call(function, *(n.number("Scale") if type_ == "float" else n.vector(next(vectors)) for type_ in types))
    return {"Value": made} if made.type == "float" else {"Vector": as_vector(made)}


@kind("ShaderNodeMapRange")
def map_range(n: Reader) -> Outputs:
    """A range laid onto another one."""
    of_vectors = n.setting("data_type", "FLOAT") == "FLOAT_VECTOR"
    way = _MAP_RANGE.get(n.setting("interpolation_type", "LINEAR"), "linear")
    clamped = n.setting("clamp", True)
    if not of_vectors:
        ends = [n.number(name) for name in ("From Min", "From Max", "To Min", "To Max")]
        steps = [n.number("Steps")] if way == "stepped" else []
        made = n.call(f"map_{way}", n.number("Value"), *ends, *steps)
        return {"Result": n.call("clamp_in_range", made, *ends[2:]) if clamped else made}
    ends = [n.vector(f"{name}_FLOAT3") for name in ("From_Min", "From_Max", "To_Min", "To_Max")]
    steps = [n.vector("Steps_FLOAT3")] if way == "stepped" else []
    made = n.call(f"map_vector_{way}", n.vector("Vector"), *ends, *steps)
    clamped = clamped and way in ("linear", "stepped")
    return {"Vector": as_vector(n.call("clamp_vector_in_range", made, *ends[2:]) if clamped else made)}


@kind("ShaderNodeClamp")
def clamp(n: Reader) -> Outputs:
    """A number between two."""
    way = "clamp_in_range" if n.setting("clamp_type", "MINMAX") == "RANGE" else "clamp_between"
    return {"Result": n.call(way, n.number("Value"), n.number("Min"), n.number("Max"))}


@kind("ShaderNodeSqueeze")
def squeeze(n: Reader) -> Outputs:
    """A sigmoid; Cycles has none, so this is EEVEE's."""
    return {"Value": n.call("squeezed", n.number("Value"), n.number("Width"), n.number("Center"))}
