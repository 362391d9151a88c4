# SPDX-License-Identifier: GPL-3.0-or-later
"""The materials of the shader balls: each is a node tree, and together they use what trees of artists use most."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from bpy.types import Material

from . import lights
from .trees import Tree, output_of


def clay(t: Tree) -> Material:
    """A rough diffuse surface, of a colour that noise shades."""
    shade = t.new("TexNoise", Vector=t.at(), Scale=6.0, Detail=4.0)
    return t.show(t.new("BsdfDiffuse", Roughness=0.9, Color=t.ramp(shade, (0.3, (0.45, 0.2, 0.12)),
                                                                  (0.7, (0.62, 0.32, 0.2)))))


def marble(t: Tree) -> Material:
    """Veins: a wave that noise bends, below varnish."""
    veins = t.new("TexWave", Vector=t.at(), Scale=1.6, Distortion=9.0, Detail=4.0, Detail_Scale=1.5)
    color = t.ramp(veins, (0.0, (0.1, 0.11, 0.14)), (0.25, (0.62, 0.6, 0.57)), (1.0, (0.85, 0.84, 0.8)))
    return t.show(t.new("BsdfPrincipled", Base_Color=color, Roughness=0.15))


def wood(t: Tree) -> Material:
    """Year rings with pores that are felt."""
    rings = t.new("TexWave", {"wave_type": "RINGS", "rings_direction": "X"}, Vector=t.at(Rotation=(0.2, 0.1, 0.4)),
                  Scale=3.0, Distortion=4.0, Detail=3.0)
    color = t.ramp(rings, (0.1, (0.16, 0.06, 0.02)), (0.9, (0.5, 0.26, 0.1)))
    return t.show(t.new("BsdfPrincipled", Base_Color=color, Roughness=0.45, Normal=t.bump(rings, 0.02, 0.6)))


def bricks(t: Tree) -> Material:
    """Bricks around the ball, their mortar deeper."""
    wall = t.new("TexBrick", Vector=t.at("UV", Scale=(2.0, 2.0, 1.0)), Scale=4.0, Mortar_Size=0.03,
                 Color1=(0.5, 0.16, 0.1), Color2=(0.34, 0.1, 0.08), Mortar=(0.5, 0.48, 0.44))
    height = t.math("SUBTRACT", 1.0, output_of(wall, "Fac"))
    return t.show(t.new("BsdfPrincipled", Base_Color=wall, Roughness=0.8, Normal=t.bump(height, 0.02)))


def checker(t: Tree) -> Material:
    """Fields of two colours and two roughnesses."""
    fields = t.new("TexChecker", Vector=t.at("Generated"), Scale=6.0, Color1=(0.75, 0.72, 0.66),
                   Color2=(0.04, 0.08, 0.2))
    rough = t.new("MapRange", Value=output_of(fields, "Fac"))
    t.feed(rough, "To Min", 0.1)
    t.feed(rough, "To Max", 0.6)
    return t.show(t.new("BsdfPrincipled", Base_Color=fields, Roughness=rough))


def scales(t: Tree) -> Material:
    """Cells of many greens with grooves between them."""
    cells = t.new("TexVoronoi", Vector=t.at(), Scale=7.0)
    edges = t.new("TexVoronoi", {"feature": "DISTANCE_TO_EDGE"}, Vector=t.at(), Scale=7.0)
    color = t.new("HueSaturation", Hue=0.5, Saturation=0.6, Value=0.8,
                  Color=t.mix(0.7, output_of(cells, "Color"), (0.08, 0.5, 0.2)))
    height = t.math("MINIMUM", output_of(edges, "Distance"), 0.12)
    return t.show(t.new("BsdfPrincipled", Base_Color=color, Roughness=0.25, Normal=t.bump(height, 0.25)))


def brushed(t: Tree) -> Material:
    """Steel that was turned on a lathe."""
    tangent = t.new("Tangent", {"direction_type": "RADIAL", "axis": "Z"})
    return t.show(t.new("BsdfPrincipled", Base_Color=(0.62, 0.63, 0.66), Metallic=1.0, Roughness=0.32, Anisotropic=0.8,
                        Tangent=tangent))


def gold(t: Tree) -> Material:
    """Gold with fingerprints."""
    smudges = t.new("TexNoise", Vector=t.at(), Scale=3.0, Detail=6.0, Roughness=0.7)
    rough = t.ramp(smudges, (0.4, (0.08, 0.08, 0.08)), (0.65, (0.4, 0.4, 0.4)))
    return t.show(t.new("BsdfPrincipled", Base_Color=(1.0, 0.72, 0.32), Metallic=1.0, Roughness=rough))


def car_paint(t: Tree) -> Material:
    """Two colours by the angle, flakes, and a clear coat."""
    angle = t.new("LayerWeight", Blend=0.4)
    color = t.mix(output_of(angle, "Facing"), (0.55, 0.02, 0.05), (0.12, 0.0, 0.25))
    return t.show(t.new("BsdfPrincipled", Base_Color=color, Metallic=0.6, Roughness=0.4, Coat_Weight=1.0,
                        Coat_Roughness=0.03))


def velvet(t: Tree) -> Material:
    """Sheen over a dark ground."""
    return t.show(t.new("BsdfPrincipled", Base_Color=(0.12, 0.01, 0.08), Roughness=0.9, Specular_IOR_Level=0.1,
                        Sheen_Weight=1.0, Sheen_Roughness=0.35, Sheen_Tint=(0.9, 0.5, 0.7)))


def wax(t: Tree) -> Material:
    """Light that goes below the surface."""
    return t.show(t.new("BsdfPrincipled", Base_Color=(0.85, 0.6, 0.35), Roughness=0.4, Subsurface_Weight=1.0,
                        Subsurface_Radius=(1.0, 0.45, 0.2), Subsurface_Scale=0.1))


def oil(t: Tree) -> Material:
    """A film that is as thin as waves of light, of uneven thickness, on metal."""
    flow = t.new("TexNoise", Vector=t.at(), Scale=1.2, Detail=2.0, Distortion=1.0)
    thickness = t.math("MULTIPLY_ADD", flow, 500.0, 150.0)
    return t.show(t.new("BsdfPrincipled", Base_Color=(0.5, 0.5, 0.5), Roughness=0.25, Specular_IOR_Level=0.9,
                        Thin_Film_Thickness=thickness))


def bottle(t: Tree) -> Material:
    """Green glass."""
    return t.show(t.new("BsdfGlass", Color=(0.55, 0.9, 0.65), Roughness=0.0, IOR=1.5))


def frosted(t: Tree) -> Material:
    """Rough refraction below clear reflection, by the angle."""
    inside = t.new("BsdfRefraction", Color=(0.8, 0.9, 1.0), Roughness=0.35, IOR=1.4)
    outside = t.new("BsdfAnisotropic", Color=(1.0, 1.0, 1.0), Roughness=0.1)
    return t.show(t.blend(t.new("Fresnel", IOR=1.4), inside, outside))


def lampshade(t: Tree) -> Material:
    """Paper in stripes that let light through."""
    stripes = t.new("TexWave", {"bands_direction": "Z"}, Vector=t.at(), Scale=4.0)
    paper = t.new("BsdfDiffuse", Color=(0.8, 0.72, 0.55))
    clear = t.new("BsdfTranslucent", Color=(0.9, 0.6, 0.25))
    return t.show(t.blend(t.math("GREATER_THAN", stripes, 0.5), paper, clear))


def lace(t: Tree) -> Material:
    """Holes where cells are."""
    cells = t.new("TexVoronoi", {"feature": "DISTANCE_TO_EDGE"}, Vector=t.at(), Scale=9.0)
    hole = t.math("GREATER_THAN", output_of(cells, "Distance"), 0.12)
    thread = t.new("BsdfPrincipled", Base_Color=(0.8, 0.78, 0.74), Roughness=0.7)
    return t.show(t.blend(hole, thread, t.new("BsdfTransparent")))


def lava(t: Tree) -> Material:
    """Cracks in rock that glow as hot bodies do."""
    cracks = t.new("TexVoronoi", {"feature": "DISTANCE_TO_EDGE"}, Scale=4.0, Vector=t.new(
        "VectorMath", Vector=t.at(), Vector_001=output_of(t.new("TexNoise", Vector=t.at(), Scale=3.0), "Color")))
    heat = t.ramp(output_of(cracks, "Distance"), (0.0, (1.0, 1.0, 1.0)), (0.09, (0.0, 0.0, 0.0)))
    glow = t.new("Emission", Color=t.new("Blackbody", Temperature=1400.0), Strength=t.math("MULTIPLY", heat, 3.0))
    rock = t.new("BsdfDiffuse", Color=(0.05, 0.045, 0.04))
    return t.show(t.new("AddShader", Shader=rock, Shader_001=glow))


def rust(t: Tree) -> Material:
    """Two materials, one where noise is high."""
    where = t.ramp(t.new("TexNoise", Vector=t.at(), Scale=2.5, Detail=8.0, Roughness=0.65),
                   (0.48, (0.0, 0.0, 0.0)), (0.55, (1.0, 1.0, 1.0)))
    paint = t.new("BsdfPrincipled", Base_Color=(0.08, 0.25, 0.4), Roughness=0.2)
    grain = t.new("TexNoise", Vector=t.at(), Scale=40.0)
    iron = t.new("BsdfPrincipled", Base_Color=t.mix(grain, (0.25, 0.08, 0.02), (0.4, 0.16, 0.05)), Roughness=0.9,
                 Normal=t.bump(grain, 0.02))
    return t.show(t.blend(where, paint, iron))


def toon(t: Tree) -> Material:
    """Two tones."""
    return t.show(t.new("BsdfToon", Color=(0.85, 0.55, 0.1), Size=0.6, Smooth=0.05))


def magic(t: Tree) -> Material:
    """The magic texture, its colours turned and bent."""
    found = t.new("TexMagic", {"turbulence_depth": 3}, Vector=t.at(), Scale=2.5, Distortion=1.5)
    turned = t.new("HueSaturation", Hue=0.65, Saturation=1.1, Value=0.8, Color=found)
    return t.show(t.new("BsdfPrincipled", Base_Color=t.new("Gamma", Color=turned, Gamma=1.4), Roughness=0.5))


def opal(t: Tree) -> Material:
    """Colours by the direction of the surface."""
    normal = t.new("VectorMath", {"operation": "MULTIPLY_ADD"}, Vector=output_of(t.new("NewGeometry"), "Normal"),
                   Vector_001=(0.4, 0.4, 0.4), Vector_002=(0.5, 0.5, 0.5))
    soft = t.new("BrightContrast", Color=normal, Bright=-0.05, Contrast=0.2)
    return t.show(t.new("BsdfPrincipled", Base_Color=soft, Roughness=0.3, Coat_Weight=0.5))


def rock(t: Tree) -> Material:
    """Ridges of noise in four dimensions."""
    ridges = t.new("TexNoise", {"noise_dimensions": "4D", "noise_type": "RIDGED_MULTIFRACTAL"}, Vector=t.at(), W=0.7,
                   Scale=1.8, Detail=6.0, Roughness=0.6, Offset=1.0, Gain=2.0)
    color = t.ramp(ridges, (0.2, (0.07, 0.06, 0.055)), (0.9, (0.5, 0.46, 0.4)))
    return t.show(t.new("BsdfPrincipled", Base_Color=color, Roughness=0.85, Normal=t.bump(ridges, 0.1)))


def tiles(t: Tree) -> Material:
    """An image from three sides, with a normal map."""
    y, x = np.mgrid[0:32, 0:32] / 32
    frame = np.minimum(np.minimum(x, 1 - x), np.minimum(y, 1 - y)) > 0.08
    wave = 0.5 + 0.5 * np.sin(2 * np.pi * x) * np.sin(2 * np.pi * y)
    plate = np.stack([0.1 + 0.1 * wave, 0.25 + 0.3 * wave, 0.5 + 0.2 * wave, np.ones_like(x)], 2)
    pixels = np.where(frame[..., None], plate, (0.6, 0.58, 0.52, 1.0)).astype("f4")
    picture = t.new("TexImage", {"projection": "BOX", "projection_blend": 0.2, "image": lights.packed_image(
        "Tiles", 32, 32, pixels.ravel())}, Vector=t.at("Generated", Scale=(3.0, 3.0, 3.0)))
    return t.show(t.new("BsdfPrincipled", Base_Color=picture, Roughness=0.2))


def denim(t: Tree) -> Material:
    """Threads across each other, of the colour that the object has."""
    across = t.new("TexWave", {"bands_direction": "X"}, Vector=t.at("UV"), Scale=30.0)
    along = t.new("TexWave", {"bands_direction": "Y"}, Vector=t.at("UV"), Scale=15.0)
    weave = t.math("MAXIMUM", across, along)
    color = t.mix(weave, (0.02, 0.03, 0.06), output_of(t.new("ObjectInfo"), "Color"))
    return t.show(t.new("BsdfPrincipled", Base_Color=color, Roughness=0.8, Sheen_Weight=0.3,
                        Normal=t.bump(weave, 0.01)))


MATERIALS: tuple[Callable[[Tree], Material], ...] = (
    clay, marble, wood, bricks, checker, scales, brushed, gold, car_paint, velvet, wax, oil, bottle, frosted, lampshade,
    lace, lava, rust, toon, magic, opal, rock, tiles, denim)
