# SPDX-License-Identifier: GPL-3.0-or-later
"""Closures."""

from __future__ import annotations

from ..expr import Constant, Expr
from ..reader import Reader
from . import Outputs, kind

# What stands in for a distribution of facets
_STAND_INS = {"BECKMANN": "GGX", "ASHIKHMIN_SHIRLEY": "GGX"}


@kind("ShaderNodeEmission", "ShaderNodeBackground")
def emission(n: Reader) -> Outputs:
    """Light that is sent out."""
    made = n.closure("closure_emission", n.color("Color"), n.number("Strength", 1.0))
    return {"Emission": made, "Background": made}


@kind("ShaderNodeBsdfDiffuse")
def diffuse(n: Reader) -> Outputs:
    """A ground of Lambert's, or a rough one."""
    return {"BSDF": n.closure("closure_diffuse", n.color("Color"), n.number("Roughness"), _normal(n))}


@kind("ShaderNodeBsdfTranslucent")
def translucent(n: Reader) -> Outputs:
    """A ground that light shines through."""
    return {"BSDF": n.closure("closure_translucent", n.color("Color"), _normal(n))}


@kind("ShaderNodeBsdfTransparent")
def transparent(n: Reader) -> Outputs:
    """What lets light through as it came."""
    return {"BSDF": n.closure("closure_transparent", n.color("Color"))}


@kind("ShaderNodeBsdfRayPortal")
def portal(n: Reader) -> Outputs:
    """Light that goes on elsewhere: not moved."""
    n.warn("light is let through where it is, not sent elsewhere")
    return {"BSDF": n.closure("closure_transparent", n.color("Color"))}


@kind("ShaderNodeHoldout")
def holdout(n: Reader) -> Outputs:
    """A hole in the picture."""
    return {"Holdout": n.closure("closure_holdout")}


@kind("ShaderNodeBsdfSheen", "ShaderNodeBsdfVelvet")
def sheen(n: Reader) -> Outputs:
    """Cloth."""
    name = "closure_velvet" if n.setting("distribution", "ASHIKHMIN") == "ASHIKHMIN" else "closure_sheen"
    return {"BSDF": n.closure(name, n.color("Color"), n.number("Roughness" if n.has("Roughness") else "Sigma"),
                              _normal(n))}


@kind("ShaderNodeBsdfToon")
def toon(n: Reader) -> Outputs:
    """Light in steps."""
    is_glossy = n.setting("component", "DIFFUSE") == "GLOSSY"
    return {"BSDF": n.closure("closure_toon", n.color("Color"), n.number("Size"), n.number("Smooth"), _normal(n),
                              n.literal(is_glossy))}


@kind("ShaderNodeBsdfAnisotropic", "ShaderNodeBsdfGlossy")
def glossy(n: Reader) -> Outputs:
    """Facets that reflect a colour at all angles."""
    return {"BSDF": n.closure(
        "closure_glossy", n.color("Color"), n.number("Roughness"), n.number("Anisotropy"), n.number("Rotation"),
        _normal(n), _tangent(n, "Anisotropy"), _bounces(n))}


@kind("ShaderNodeBsdfMetallic")
def metallic(n: Reader) -> Outputs:
    """A metal by colours, or by its index of refraction and extinction."""
    is_physical = n.setting("fresnel_type", "F82") == "PHYSICAL_CONDUCTOR"
    colors = (n.vector("IOR"), n.vector("Extinction")) if is_physical else (n.color("Base Color"), n.color("Edge Tint"))
    _warn_of_film(n)
    return {"BSDF": n.closure(
        "closure_conductor" if is_physical else "closure_metallic", *colors, n.number("Roughness"),
        n.number("Anisotropy"), n.number("Rotation"), _normal(n), _tangent(n, "Anisotropy"), _bounces(n))}


@kind("ShaderNodeBsdfGlass")
def glass(n: Reader) -> Outputs:
    """A body that light enters and leaves."""
    _warn_of_film(n)
    return {"BSDF": n.closure("closure_glass", n.color("Color"), n.number("Roughness"), n.number("IOR", 1.5),
                              _normal(n), _bounces(n))}


@kind("ShaderNodeBsdfRefraction")
def refraction(n: Reader) -> Outputs:
    """The light that enters, alone."""
    _bounces(n)
    return {"BSDF": n.closure("closure_refraction", n.color("Color"), n.number("Roughness"), n.number("IOR", 1.45),
                              _normal(n))}


@kind("ShaderNodeSubsurfaceScattering")
def subsurface(n: Reader) -> Outputs:
    """Light that goes on below the surface: a diffuse ground of that colour."""
    n.warn("light does not spread below the surface: it leaves where it came")
    return {"BSSRDF": n.closure("closure_subsurface", n.color("Color"), _normal(n))}


@kind("ShaderNodeBsdfHair")
def hair(n: Reader) -> Outputs:
    """Hair as a surface: gloss, or light from behind."""
    n.warn("hair is shaded as a surface")
    if n.setting("component", "Reflection") == "Transmission":
        return {"BSDF": n.closure("closure_translucent", n.color("Color"), n.call("normal_of_point"))}
    zero = n.value(0.0)
    return {"BSDF": n.closure(
        "closure_glossy", n.color("Color"), n.number("RoughnessU"), zero, zero, n.call("normal_of_point"),
        n.value((0.0, 0.0, 0.0)), n.literal(True))}


@kind("ShaderNodeBsdfHairPrincipled")
def principled_hair(n: Reader) -> Outputs:
    """Hair as a surface of the colour that much of it has."""
    n.warn("hair is shaded as a diffuse surface of its colour")
    by = n.setting("parametrization", "COLOR")
    if by == "COLOR":
        color = n.color("Color")
    elif by == "ABSORPTION":
        color = n.call("hair_color", n.vector("Absorption Coefficient"), n.number("Radial Roughness", 0.3))
    else:
        color = n.call("melanin_color", n.number("Melanin"), n.number("Melanin Redness"),
                       n.color("Tint", (1.0, 1.0, 1.0)), n.number("Radial Roughness", 0.3))
    return {"BSDF": n.closure("closure_diffuse", color, n.value(0.0), n.call("normal_of_point"))}


@kind("ShaderNodeEeveeSpecular")
def specular(n: Reader) -> Outputs:
    """EEVEE's own, of which Cycles makes nothing."""
    n.warn("Cycles knows no such node: black")
    return {"BSDF": None}


@kind("ShaderNodeBsdfPrincipled")
def principled(n: Reader) -> Outputs:
    """All of it."""
    if _is_used(n, "Subsurface Weight"):
        n.warn("light does not spread below the surface: it leaves where it came")
    is_filmed = _is_used(n, "Thin Film Thickness")
    film = (n.number("Thin Film Thickness"), n.number("Thin Film IOR", 1.33)) if is_filmed else ()
    white, normal = (1.0, 1.0, 1.0), _normal(n)
    coat_normal = n.vector("Coat Normal", lambda: n.call("normal_of_point"))
    return {"BSDF": n.closure(
        "closure_principled_filmed" if is_filmed else "closure_principled", n.color("Base Color"),
        n.number("Metallic"), n.number("Roughness"), n.number("IOR", 1.5), n.number("Alpha", 1.0), normal,
        n.number("Diffuse Roughness"), n.number("Subsurface Weight"), n.number("Specular IOR Level", 0.5),
        n.color("Specular Tint", white), n.number("Anisotropic"),
        n.number("Anisotropic Rotation"), _tangent(n, "Anisotropic"), n.number("Transmission Weight"),
        n.number("Coat Weight"), n.number("Coat Roughness", 0.03), n.number("Coat IOR", 1.5),
        n.color("Coat Tint", white), coat_normal, n.number("Sheen Weight"), n.number("Sheen Roughness", 0.5),
        n.color("Sheen Tint", white), n.color("Emission Color", white), n.number("Emission Strength"), *film,
        _bounces(n))}


def _normal(n: Reader) -> Expr:
    return n.vector("Normal", lambda: n.call("normal_of_point"))


def _tangent(n: Reader, anisotropy: str) -> Expr:
    """Where facets have a grain, along which it runs: round the object's own z where nothing says otherwise."""
    if not _is_used(n, anisotropy):
        return n.value((0.0, 0.0, 0.0))
    return n.vector("Tangent", lambda: n.call("radial_tangent", n.literal(2)))


def _bounces(n: Reader) -> Expr:
    """Whether light goes on from facet to facet; tells of distributions that another one stands in for."""
    name = n.setting("distribution", "MULTI_GGX")
    if name in _STAND_INS:
        n.warn(f"distribution {name}: {_STAND_INS[name]} stands in")
    return n.literal(name == "MULTI_GGX")


def _is_used(n: Reader, identifier: str) -> bool:
    """Whether an input may be other than zero."""
    found = n.number(identifier)
    return not isinstance(found, Constant) or any(found.value)


def _warn_of_film(n: Reader) -> None:
    if _is_used(n, "Thin Film Thickness"):
        n.warn("the thin film is left out")
