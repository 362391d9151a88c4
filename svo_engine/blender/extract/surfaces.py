# SPDX-License-Identifier: GPL-3.0-or-later
"""Shader nodes as Principled values: each BSDF, and Mix and Add Shader where the result is exact."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ...scene.types import Color, Material
from .nodes import Port, origin
from .reader import WHITE, Reader, Value

_NO_LIGHT: Color = (0.0, 0.0, 0.0)

# Neither reflects nor shines; what an unlinked shader socket stands for
NOTHING = Material("", base_color=_NO_LIGHT, specular_level=0.0, roughness=1.0)

# Principled sockets that change the picture only when they are above 0, and that we leave out
_LEFT_OUT = ("Diffuse Roughness", "Subsurface Weight", "Anisotropic", "Coat Weight", "Sheen Weight",
             "Thin Film Thickness")


def surface(reader: Reader, port: Port | None) -> Material:
    """The nameless material that the shader output `port` describes."""
    if port is None or port.is_constant:
        return NOTHING
    make = _SHADERS.get(port.node.bl_idname)
    if make is None:
        reader.warn(f"shader node '{port.node.name}' ({port.node.bl_label}) is not supported; "
                    "it is drawn as a Diffuse BSDF")
        make = _diffuse
    return make(reader, port)


def _principled(reader: Reader, port: Port) -> Material:
    base, roughness, metallic, alpha = (reader.value(port, n) for n in ("Base Color", "Roughness", "Metallic", "Alpha"))
    left_out = [n for n in _LEFT_OUT if (at := port.input(n)) and not _is_zero(at)]
    if left_out:
        reader.warn(f"{', '.join(left_out)} of node '{port.node.name}' is left out")
    emission = _emitted(reader, port, "Emission Color", "Emission Strength")
    return replace(
        _with_normal(reader, port, Material("")), base_color=base.color, base_color_texture=base.texture,
        roughness=roughness.number, roughness_texture=roughness.texture,
        metallic=metallic.number, metallic_texture=metallic.texture, alpha=alpha.number, alpha_texture=alpha.texture,
        emission=emission.color, emission_texture=emission.texture,
        ior=_number(reader, port, "IOR"), specular_level=_number(reader, port, "Specular IOR Level"),
        specular_tint=reader.constant(port, "Specular Tint", 1.0),
        transmission=_number(reader, port, "Transmission Weight"))


def _diffuse(reader: Reader, port: Port) -> Material:
    color = reader.value(port, "Color", 0.8)
    return replace(_with_normal(reader, port, NOTHING), base_color=color.color, base_color_texture=color.texture)


def _glossy(reader: Reader, port: Port) -> Material:
    return _metal(reader, port, reader.value(port, "Color"))


def _metallic(reader: Reader, port: Port) -> Material:
    return replace(_metal(reader, port, reader.value(port, "Base Color")),
                   specular_tint=reader.constant(port, "Edge Tint", 1.0))


def _metal(reader: Reader, port: Port, base: Value) -> Material:
    roughness = reader.value(port, "Roughness")
    return replace(
        _with_normal(reader, port, Material("")), metallic=1.0, base_color=base.color, base_color_texture=base.texture,
        roughness=roughness.number, roughness_texture=roughness.texture)


def _glass(reader: Reader, port: Port) -> Material:
    """Light takes the node's colour at each interface, where Principled's takes the root of it."""
    color = reader.value(port, "Color")
    if color.texture < 0:
        r, g, b = color.color
        color = Value((r * r, g * g, b * b))
    return replace(_metal(reader, port, color), metallic=0.0, transmission=1.0, ior=_number(reader, port, "IOR"))


def _transparent(reader: Reader, port: Port) -> Material:
    if reader.value(port, "Color").color != WHITE:
        reader.warn(f"the colour of node '{port.node.name}' is left out; it lets all light through")
    return replace(NOTHING, alpha=0.0)


def _emission(reader: Reader, port: Port) -> Material:
    emission = _emitted(reader, port, "Color", "Strength")
    return replace(NOTHING, emission=emission.color, emission_texture=emission.texture)


def _mix(reader: Reader, port: Port) -> Material:
    """(1 - factor) of the first shader, factor of the second."""
    factor = reader.value(port, "Fac")
    weight = min(max(factor.number, 0.0), 1.0)
    if factor.texture < 0 and weight in (0.0, 1.0):
        return _input(reader, port, "Shader_001" if weight else "Shader")
    first, second = _input(reader, port, "Shader"), _input(reader, port, "Shader_001")
    exact = None
    if _is_transparent(first):
        exact = _covered(second, Value((weight,) * 3, factor.texture))
    elif factor.texture < 0 and _is_transparent(second):
        exact = _covered(first, Value((1 - weight,) * 3))
    elif factor.texture < 0:
        exact = _sum(_scaled(first, 1 - weight), _scaled(second, weight))
    if exact is None:
        reader.warn(f"Mix Shader '{port.node.name}' cannot be drawn exactly; only one of its shaders is used")
    return exact or (second if weight > 0.5 else first)


def _add(reader: Reader, port: Port) -> Material:
    first, second = _input(reader, port, "Shader"), _input(reader, port, "Shader_001")
    exact = _sum(first, second)
    if exact is None:
        reader.warn(f"Add Shader '{port.node.name}' cannot be drawn exactly; only one of its shaders is used")
    return exact or first


def _input(reader: Reader, port: Port, identifier: str) -> Material:
    at = port.input(identifier)
    return surface(reader, origin(at) if at else None)


def _covered(material: Material, factor: Value) -> Material | None:
    """`material` where the factor is 1, nothing where it is 0; None if two textures would multiply."""
    if material.alpha_texture >= 0 and factor.texture >= 0:
        return None
    return replace(material, alpha=material.alpha * factor.number,
                   alpha_texture=max(material.alpha_texture, factor.texture))


def _scaled(material: Material, weight: float) -> Material | None:
    """All light of `material` times `weight`; None if its values cannot say that: only diffuse and emission can."""
    if not _is_opaque(material) or material.specular_level or material.metallic or material.transmission:
        return None
    return replace(material, base_color=_times(material.base_color, weight), emission=_times(material.emission, weight))


def _sum(first: Material | None, second: Material | None) -> Material | None:
    """Both lights together; None unless one of the two only shines and at most one of their emissions has a texture."""
    if first is None or second is None:
        return None
    lamp, other = (first, second) if _only_shines(first) else (second, first)
    if not _only_shines(lamp) or not _is_opaque(other):
        return None
    if not any(lamp.emission):
        return other
    if not any(other.emission):
        return replace(other, emission=lamp.emission, emission_texture=lamp.emission_texture)
    if lamp.emission_texture >= 0 or other.emission_texture >= 0:
        return None
    r, g, b = (x + y for x, y in zip(lamp.emission, other.emission, strict=True))
    return replace(other, emission=(r, g, b))


def _only_shines(material: Material) -> bool:
    return replace(material, emission=_NO_LIGHT, emission_texture=-1) == NOTHING


def _is_opaque(material: Material) -> bool:
    return material.alpha == 1 and material.alpha_texture < 0


def _is_transparent(material: Material) -> bool:
    return material == replace(NOTHING, alpha=0.0)


def _times(color: Color, factor: float) -> Color:
    return color[0] * factor, color[1] * factor, color[2] * factor


def _emitted(reader: Reader, port: Port, color: str, strength: str) -> Value:
    """Radiance [W m^-2 sr^-1]. What has no strength does not read its colour's image."""
    factor = reader.value(port, strength)
    if factor.texture < 0 and factor.number == 0:
        return Value(_NO_LIGHT)
    return reader.product(reader.value(port, color), factor)


def _number(reader: Reader, port: Port, identifier: str) -> float:
    return Value(reader.constant(port, identifier)).number


def _is_zero(at: Port) -> bool:
    before = origin(at)
    return before.is_constant and before.socket.default_value == 0


def _with_normal(reader: Reader, port: Port, material: Material) -> Material:
    """`material` with the normal map that feeds the Normal input."""
    at = port.input("Normal")
    before = origin(at) if at else None
    if before is None or before.is_constant:
        return material
    node = before.node
    if node.bl_idname != "ShaderNodeNormalMap" or node.space != "TANGENT":
        reader.warn(f"node '{node.name}' ({node.bl_label}) is not supported for normals; the smooth normal is used")
        return material
    if node.uv_map:
        reader.uv_maps.add(node.uv_map)
    return replace(material, normal_texture=reader.value(before, "Color").texture,
                   normal_strength=_number(reader, before, "Strength"))


_SHADERS: dict[str, Callable[[Reader, Port], Material]] = {
    "ShaderNodeBsdfPrincipled": _principled,
    "ShaderNodeBsdfDiffuse": _diffuse,
    "ShaderNodeBsdfAnisotropic": _glossy,
    "ShaderNodeBsdfGlossy": _glossy,
    "ShaderNodeBsdfMetallic": _metallic,
    "ShaderNodeBsdfGlass": _glass,
    "ShaderNodeBsdfTransparent": _transparent,
    "ShaderNodeEmission": _emission,
    "ShaderNodeBackground": _emission,
    "ShaderNodeMixShader": _mix,
    "ShaderNodeAddShader": _add,
}
