# SPDX-License-Identifier: GPL-3.0-or-later
"""What has come to a point, and what is known of it only where it is another thing than a mesh."""

from __future__ import annotations

from ...scene.layouts import CONSTANTS
from ..expr import Expr, Literal, as_vector
from ..reader import Reader
from . import Outputs, kind
from .inputs import normal_of

_RAYS = {"Is Camera Ray": ("CAMERA",), "Is Shadow Ray": ("SHADOW",), "Is Diffuse Ray": ("DIFFUSE",),
         "Is Glossy Ray": ("GLOSSY",), "Is Singular Ray": ("SINGULAR",), "Is Reflection Ray": ("REFLECTION",),
         "Is Transmission Ray": ("TRANSMISSION",)}
_DEPTHS = {"Diffuse Depth": ("DIFFUSE",), "Glossy Depth": ("GLOSSY",), "Transmission Depth": ("TRANSMISSION",)}


@kind("ShaderNodeLightPath")
def light_path(n: Reader) -> Outputs:
    """Which ray sees the point."""
    made: dict[str, Expr] = {name: n.call("is_ray", _bits(which)) for name, which in _RAYS.items()}
    made |= {name: n.call("ray_depth_of", _bits(which)) for name, which in _DEPTHS.items()}
    made |= {name: n.value(0.0) for name in ("Is Volume Scatter Ray", "Transparent Depth", "Portal Depth")}
    return {**made, "Ray Length": n.call("ray_length"), "Ray Depth": n.call("ray_depth")}


def _bits(names: tuple[str, ...]) -> Literal:
    return Literal("uint", (sum(CONSTANTS[f"RAY_{name}"] for name in names),))


@kind("ShaderNodeWireframe")
def wireframe(n: Reader) -> Outputs:
    """Edges of triangles."""
    return {"Fac": n.call("wireframe", n.number("Size", 0.01), n.literal(bool(n.setting("use_pixel_size", False))))}


@kind("ShaderNodeAmbientOcclusion")
def ambient_occlusion(n: Reader) -> Outputs:
    """As if nothing were near."""
    n.warn("ambient occlusion is not supported; nothing is darkened")
    return {"Color": n.color("Color", (1.0, 1.0, 1.0)), "AO": n.value(1.0)}


@kind("ShaderNodeBevel")
def bevel(n: Reader) -> Outputs:
    """Sharp edges."""
    n.warn("bevels are not supported; the surface's own normal is used")
    return {"Normal": normal_of(n)}


@kind("ShaderNodeParticleInfo")
def particle_info(n: Reader) -> Outputs:
    """The particle that an instance is; zeros for what is none."""
    numbers = n.attribute("particle:numbers")
    made: dict[str, Expr] = {name: n.call("attribute_component", numbers, n.literal(i))
                             for i, name in enumerate(("Index", "Age", "Lifetime", "Size"))}
    for name in ("Location", "Velocity", "Angular Velocity"):
        vector = n.attribute(f"particle:{name.lower().replace(' ', '_')}")
        made[name] = as_vector(n.call("attribute_vector", vector))
    return {**made, "Random": n.call("random_of_index", made["Index"])}


@kind("ShaderNodeHairInfo")
def hair_info(n: Reader) -> Outputs:
    """What Cycles gives for what is no strand."""
    return {**_zeros(n, ("Is Strand", "Intercept", "Length", "Thickness", "Random")),
            **_zero_vectors(n, ("Tangent Normal",))}


@kind("ShaderNodePointInfo")
def point_info(n: Reader) -> Outputs:
    """What Cycles gives for what is no point."""
    return {**_zeros(n, ("Radius", "Random")), **_zero_vectors(n, ("Position",))}


@kind("ShaderNodeVolumeInfo")
def volume_info(n: Reader) -> Outputs:
    """What Cycles gives for what is no volume."""
    return {**_zeros(n, ("Density", "Flame", "Temperature")), "Color": n.value((0.0, 0.0, 0.0))}


def _zeros(n: Reader, names: tuple[str, ...]) -> dict[str, Expr]:
    return {name: n.value(0.0) for name in names}


def _zero_vectors(n: Reader, names: tuple[str, ...]) -> dict[str, Expr]:
    return {name: as_vector(n.value((0.0, 0.0, 0.0))) for name in names}
