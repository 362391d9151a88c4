# SPDX-License-Identifier: GPL-3.0-or-later
"""Cartoon shading: light as a colour."""

from __future__ import annotations

from ..reader import Reader
from . import LIT, Outputs, kind


@kind("ShaderNodeShaderToRGB")
def shader_to_rgb(n: Reader) -> Outputs:
    """What the shader sends to the eye, as EEVEE has it. Cycles has no such node."""
    return {"Color": n.call("lit_color"), "Alpha": n.value(1.0), LIT: n.shader("Shader")}
