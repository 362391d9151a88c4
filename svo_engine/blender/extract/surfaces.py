# SPDX-License-Identifier: GPL-3.0-or-later
"""Shader nodes as Principled values: each BSDF, and Mix and Add Shader. Where the values cannot say what the nodes do
the reader is told, and they stand in for the compiled tree.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ...scene.types import Color, Material
from .nodes import Port, origin
from .reader import DEEPEST, WHITE, Reader, Value

_NO_LIGHT: Color = (0.0, 0.0, 0.0)

# The colour of a normal map that changes nothing
_FLAT: Color = (0.5, 0.5, 1.0)

# Neither reflects nor shines; what an unlinked shader socket stands for
NOTHING = Material("", base_color=_NO_LIGHT, specular_level=0.0, roughness=1.0)

# Sockets that change the picture only when they are above 0, and that the values leave out
_LEFT_OUT = ("Diffuse Roughness", "Subsurface Weight", "Anisotropic", "Coat Weight", "Sheen Weight",
             "Thin Film Thickness", "Anisotropy")


def surface(reader: Reader, port: Port | None) -> Material:
    """The nameless material that the shader output `port` describes. Many may show one, so each is read once."""
    if port is None or port.is_constant:
        return NOTHING
    key = tuple(thing.as_pointer() for thing in (port.socket, *port.groups))
    if key not in reader.surfaces:
        if reader.depth >= DEEPEST:
            reader.guess(f"more than {DEEPEST} shaders in a row are not supported; the first ones are left out")
            return NOTHING
        reader.depth += 1
        reader.surfaces[key] = _read(reader, port)
        reader.depth -= 1
    return reader.surfaces[key]


def _read(reader: Reader, port: Port) -> Material:
    if port.socket.type != "SHADER":  # a colour or a number as a surface shines, as Cycles has it
        value = reader.of(port)
        return replace(NOTHING, emission=value.color, emission_texture=value.texture)
    make = _SHADERS.get(port.node.bl_idname)
    if make is None:
        reader.guess(f"shader node '{port.node.name}' ({port.node.bl_label}) is not supported; "
                     "it is drawn as a Diffuse BSDF")
        make = _diffuse
    return make(reader, port)


def _principled(reader: Reader, port: Port) -> Material:
    base, roughness, metallic, alpha = (reader.value(port, n) for n in ("Base Color", "Roughness", "Metallic", "Alpha"))
    _look_for_more(reader, port, _LEFT_OUT)
    emission = _emitted(reader, port, "Emission Color", "Emission Strength")
    return replace(
        _with_normal(reader, port, Material("")), base_color=base.color, base_color_texture=base.texture,
        roughness=roughness.number, roughness_texture=roughness.texture,
        metallic=metallic.number, metallic_texture=metallic.texture, alpha=alpha.number, alpha_texture=alpha.texture,
        emission=emission.color, emission_texture=emission.texture,
        ior=_number(reader, port, "IOR"), specular_level=_number(reader, port, "Specular IOR Level"),
        specular_tint=reader.constant(port, "Specular Tint", 1.0),
        transmission=_number(reader, port, "Transmission Weight"))


def _look_for_more(reader: Reader, port: Port, sockets: tuple[str, ...]) -> None:
    """Tell which of `sockets` have an effect that the values leave out, and which distribution."""
    left_out = [n for n in sockets if (at := port.input(n)) and not _is_zero(at)]
    if left_out:
        reader.guess(f"{', '.join(left_out)} of node '{port.node.name}' is left out")
    if getattr(port.node, "distribution", "MULTI_GGX") != "MULTI_GGX":
        reader.guess(f"node '{port.node.name}' is drawn with the distribution Multiscatter GGX")


def _diffuse(reader: Reader, port: Port) -> Material:
    _look_for_more(reader, port, ("Roughness",))
    color = reader.value(port, "Color", 0.8)
    return replace(_with_normal(reader, port, NOTHING), base_color=color.color, base_color_texture=color.texture)


def _glossy(reader: Reader, port: Port) -> Material:
    """The node has its colour at all angles, which the values have for white alone."""
    _look_for_more(reader, port, _LEFT_OUT)
    color = reader.value(port, "Color")
    _look_for_tint(reader, port, color)
    return _metal(reader, port, color)


def _look_for_tint(reader: Reader, port: Port, color: Value) -> None:
    if color != Value(WHITE):
        reader.guess(f"reflections of node '{port.node.name}' do not have its colour at all angles")


def _metallic(reader: Reader, port: Port) -> Material:
    _look_for_more(reader, port, _LEFT_OUT)
    if port.node.fresnel_type != "F82":
        reader.guess(f"node '{port.node.name}' is drawn by its colours, not as a physical conductor")
    return replace(_metal(reader, port, reader.value(port, "Base Color")),
                   specular_tint=reader.constant(port, "Edge Tint", 1.0))


def _metal(reader: Reader, port: Port, base: Value) -> Material:
    roughness = reader.value(port, "Roughness")
    return replace(
        _with_normal(reader, port, Material("")), metallic=1.0, base_color=base.color, base_color_texture=base.texture,
        roughness=roughness.number, roughness_texture=roughness.texture)


def _glass(reader: Reader, port: Port) -> Material:
    """Light takes the node's colour at each interface, where Principled's takes the root of it."""
    _look_for_more(reader, port, _LEFT_OUT)
    color = reader.value(port, "Color")
    _look_for_tint(reader, port, color)
    if color.texture < 0:
        r, g, b = color.color
        color = Value((r * r, g * g, b * b))
    return replace(_metal(reader, port, color), metallic=0.0, transmission=1.0, ior=_number(reader, port, "IOR"))


def _transparent(reader: Reader, port: Port) -> Material:
    if reader.value(port, "Color").color != WHITE:
        reader.guess(f"the colour of node '{port.node.name}' is left out; it lets all light through")
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
        reader.guess(f"Mix Shader '{port.node.name}' cannot be drawn exactly; only one of its shaders is used")
    return exact or (second if weight > 0.5 else first)


def _add(reader: Reader, port: Port) -> Material:
    first, second = _input(reader, port, "Shader"), _input(reader, port, "Shader_001")
    exact = _sum(first, second)
    if exact is None:
        reader.guess(f"Add Shader '{port.node.name}' cannot be drawn exactly; only one of its shaders is used")
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
        reader.guess(f"node '{node.name}' ({node.bl_label}) is not supported for normals; the smooth normal is used")
        return material
    if node.uv_map:
        reader.uv_maps.add(node.uv_map)
    color = reader.value(before, "Color")
    if color.texture < 0 and color.color != _FLAT:
        reader.guess(f"node '{node.name}' has no texture; the smooth normal is used")
    return replace(material, normal_texture=color.texture,
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
