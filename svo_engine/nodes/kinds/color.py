# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes that adjust, mix, take apart and put together colours, and vectors likewise."""

from __future__ import annotations

from ..expr import Expr, as_vector
from ..reader import Reader
from . import Outputs, kind

_BLENDS = {"MIX": "blend", "DARKEN": "darken", "MULTIPLY": "multiply", "BURN": "burn", "LIGHTEN": "lighten",
           "SCREEN": "screen", "DODGE": "dodge", "ADD": "add", "OVERLAY": "overlay", "SOFT_LIGHT": "soft_light",
           "LINEAR_LIGHT": "linear_light", "DIFFERENCE": "difference", "EXCLUSION": "exclusion",
           "SUBTRACT": "subtract", "DIVIDE": "divide", "HUE": "hue", "SATURATION": "saturation", "COLOR": "color",
           "VALUE": "value"}


@kind("ShaderNodeRGB")
def rgb(n: Reader) -> Outputs:
    """A colour."""
    return {"Color": n.value(tuple(n.setting("value", (0.0, 0.0, 0.0)))[:3])}


@kind("ShaderNodeBrightContrast")
def bright_contrast(n: Reader) -> Outputs:
    """Brightness and contrast."""
    return {"Color": n.call("bright_contrast", n.color("Color"), n.number("Bright"), n.number("Contrast"))}


@kind("ShaderNodeGamma")
def gamma(n: Reader) -> Outputs:
    """A power of each part."""
    return {"Color": n.call("color_to_power", n.color("Color"), n.number("Gamma", 1.0))}


@kind("ShaderNodeHueSaturation")
def hue_saturation(n: Reader) -> Outputs:
    """Hue, saturation and value changed."""
    return {"Color": n.call("hue_saturation_value", n.number("Hue", 0.5), n.number("Saturation", 1.0),
                            n.number("Value", 1.0), n.number("Fac", 1.0), n.color("Color"))}


@kind("ShaderNodeInvert")
def invert(n: Reader) -> Outputs:
    """What is missing to white."""
    return {"Color": n.call("inverted", n.number("Fac", 1.0), n.color("Color"))}


@kind("ShaderNodeRGBToBW")
def luminance(n: Reader) -> Outputs:
    """The luminance of a colour."""
    return {"Val": n.call("luminance_of", n.color("Color"))}


@kind("ShaderNodeLightFalloff")
def light_falloff(n: Reader) -> Outputs:
    """Strengths that undo the inverse square of the distance."""
    made = n.call("light_falloff", n.number("Strength", 100.0), n.number("Smooth"))
    return {name: made[name.lower()] for name in ("Quadratic", "Linear", "Constant")}


@kind("ShaderNodeMix")
def mix(n: Reader) -> Outputs:
    """Numbers, vectors or colours mixed."""
    what, clamped = n.setting("data_type", "FLOAT"), n.setting("clamp_factor", True)
    if what == "VECTOR" and n.setting("factor_mode", "UNIFORM") == "NON_UNIFORM":
        parts = n.vector("Factor_Vector", (0.5, 0.5, 0.5))
        parts = n.call("factors_clamped", parts) if clamped else parts
        made = n.call("mix_vector_by_parts", parts, n.vector("A_Vector"), n.vector("B_Vector"))
        return {"Result_Vector": as_vector(made)}
    t = n.number("Factor_Float", 0.5)
    t = n.call("math_clamped", t) if clamped else t
    if what == "VECTOR":
        return {"Result_Vector": as_vector(n.call("mix_vector", t, n.vector("A_Vector"), n.vector("B_Vector")))}
    if what == "RGBA":
        made = _blended(n, t, n.color("A_Color"), n.color("B_Color"))
        return {"Result_Color": n.call("color_clamped", made) if n.setting("clamp_result", False) else made}
    return {"Result_Float": n.call("mix_number", t, n.number("A_Float"), n.number("B_Float"))}


@kind("ShaderNodeMixRGB")
def mix_rgb(n: Reader) -> Outputs:
    """Colours mixed, in older files."""
    t = n.call("math_clamped", n.number("Fac", 0.5))
    made = _blended(n, t, n.color("Color1"), n.color("Color2"))
    return {"Color": n.call("color_clamped", made) if n.setting("use_clamp", False) else made}


def _blended(n: Reader, t: Expr, a: Expr, b: Expr) -> Expr:
    way = n.setting("blend_type", "MIX")
    if way not in _BLENDS:
        n.warn(f"blend mode {way} is not known; plain mixing stands in")
    return n.call(f"mix_{_BLENDS.get(way, 'blend')}", t, a, b)
