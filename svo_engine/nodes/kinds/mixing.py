# SPDX-License-Identifier: GPL-3.0-or-later
"""Shaders of shaders."""

from __future__ import annotations

from ..closures import Mixture
from ..reader import Reader
from . import Outputs, kind


@kind("ShaderNodeMixShader")
def mix(n: Reader) -> Outputs:
    """Shares of two."""
    return {"Shader": Mixture(n.number("Fac", 0.5), n.shader("Shader"), n.shader("Shader_001"))}


@kind("ShaderNodeAddShader")
def add(n: Reader) -> Outputs:
    """Two at once."""
    return {"Shader": Mixture(None, n.shader("Shader"), n.shader("Shader_001"))}
