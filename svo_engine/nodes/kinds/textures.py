# SPDX-License-Identifier: GPL-3.0-or-later
"""Textures that are computed: checkers, gradients, magic, waves, bricks, white noise, Gabor noise."""

from __future__ import annotations

from ..expr import Expr
from ..reader import Reader
from . import Outputs, kind
from .textures_space import dimensions, grey, place

_BANDS = {"X": (20.0, 0.0, 0.0), "Y": (0.0, 20.0, 0.0), "Z": (0.0, 0.0, 20.0), "DIAGONAL": (10.0, 10.0, 10.0)}
_RINGS = {"X": (0.0, 1.0, 1.0), "Y": (1.0, 0.0, 1.0), "Z": (1.0, 1.0, 0.0), "SPHERICAL": (1.0, 1.0, 1.0)}
_PROFILES = {"SIN": "wave_sine", "SAW": "wave_saw", "TRI": "wave_triangle"}
_WAVE = ("Scale", "Phase Offset", "Distortion", "Detail", "Detail Scale", "Detail Roughness")


@kind("ShaderNodeTexChecker")
def checker(n: Reader) -> Outputs:
    """Cubes of two colours in turns."""
    out = n.call("texture_checker", place(n), n.color("Color1"), n.color("Color2"), n.number("Scale"))
    return {"Color": out["color"], "Fac": out["factor"]}


@kind("ShaderNodeTexGradient")
def gradient(n: Reader) -> Outputs:
    """Grey from 0 to 1."""
    return grey(n.call(f"gradient_{n.setting('gradient_type', 'LINEAR').lower()}", place(n)))


@kind("ShaderNodeTexMagic")
def magic(n: Reader) -> Outputs:
    """Waves that have passed through each other."""
    depth = n.literal(int(n.setting("turbulence_depth", 2)))
    color = n.call("texture_magic", depth, place(n), n.number("Scale"), n.number("Distortion"))
    return {"Color": color, "Fac": n.call("number_of_vector", color)}


@kind("ShaderNodeTexWave")
def wave(n: Reader) -> Outputs:
    """Bands or rings."""
    is_rings = n.setting("wave_type", "BANDS") == "RINGS"
    shape = _RINGS[n.setting("rings_direction", "X")] if is_rings else _BANDS[n.setting("bands_direction", "X")]
    phase = n.call("wave_rings" if is_rings else "wave_bands", n.literal(shape), place(n), *map(n.number, _WAVE))
    return grey(n.call(_PROFILES[n.setting("wave_profile", "SIN")], phase))


@kind("ShaderNodeTexBrick")
def brick(n: Reader) -> Outputs:
    """Bricks in mortar."""
    colors = map(n.color, ("Color1", "Color2", "Mortar"))
    sizes = map(n.number, ("Scale", "Mortar Size", "Mortar Smooth", "Bias", "Brick Width", "Row Height"))
    rows = (n.value(float(n.setting(name, default))) for name, default in (
        ("offset", 0.5), ("offset_frequency", 2), ("squash", 1.0), ("squash_frequency", 2)))
    out = n.call("texture_brick", place(n), *colors, *sizes, *rows)
    return {"Color": out["color"], "Fac": out["factor"]}


@kind("ShaderNodeTexWhiteNoise")
def white_noise(n: Reader) -> Outputs:
    """A number for each point, which knows of no other."""
    given = (n.literal(dimensions(n, "noise_dimensions")), n.vector("Vector"), n.number("W"))
    return {"Value": n.call("white_noise", *given), "Color": n.call("white_noise_color", *given)}


@kind("ShaderNodeTexGabor")
def gabor(n: Reader) -> Outputs:
    """Waves of one frequency, in one direction or in all."""
    given = (place(n), n.number("Scale"), n.number("Frequency"), n.number("Anisotropy"))
    if n.setting("gabor_type", "2D") == "3D":
        out = n.call("texture_gabor_3d", *given, n.vector("Orientation 3D"))
    else:
        out = n.call("texture_gabor_2d", *given, n.number("Orientation 2D"))
    return {"Value": out["value"], "Phase": out["phase"], "Intensity": out["intensity"]}


@kind("ShaderNodeTexPointDensity")
def point_density(n: Reader) -> Outputs:
    """Nothing: it is of volumes, and Blender has it no more."""
    n.warn("point densities are not supported; it is empty")
    nothing: Expr = n.value(0.0)
    return {"Color": nothing, "Density": nothing}
