# SPDX-License-Identifier: GPL-3.0-or-later
"""Closures."""

from __future__ import annotations

from ..reader import Reader
from . import Outputs, kind


@kind("ShaderNodeEmission", "ShaderNodeBackground")
def emission(n: Reader) -> Outputs:
    """Light that is sent out."""
    made = n.closure("closure_emission", n.color("Color"), n.number("Strength", 1.0))
    return {"Emission": made, "Background": made}


@kind("ShaderNodeBsdfDiffuse")
def diffuse(n: Reader) -> Outputs:
    """A rough ground."""
    return {"BSDF": n.closure("closure_diffuse", n.color("Color"), n.number("Roughness"),
                              n.vector("Normal", lambda: n.call("normal_of_point")))}


@kind("ShaderNodeBsdfTransparent")
def transparent(n: Reader) -> Outputs:
    """What lets light through as it came."""
    return {"BSDF": n.closure("closure_transparent", n.color("Color"))}
