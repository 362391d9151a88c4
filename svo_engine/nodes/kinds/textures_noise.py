# SPDX-License-Identifier: GPL-3.0-or-later
"""Textures of gradient noise, and of cells."""

from __future__ import annotations

from collections.abc import Sequence

from ..expr import Expr, as_vector
from ..reader import Reader
from . import Outputs, kind
from .textures_space import dimensions, place

# Of a type of noise: its function, and the inputs that it takes after detail, roughness and lacunarity
_TYPES: dict[str, tuple[str, tuple[str, ...]]] = {
    "FBM": ("noise_fbm", ()),
    "MULTIFRACTAL": ("noise_multifractal", ()),
    "HETERO_TERRAIN": ("noise_hetero", ("Offset",)),
    "HYBRID_MULTIFRACTAL": ("noise_hybrid", ("Offset", "Gain")),
    "RIDGED_MULTIFRACTAL": ("noise_ridged", ("Offset", "Gain")),
}
_METRICS = {"EUCLIDEAN": 0, "MANHATTAN": 1, "CHEBYCHEV": 2, "MINKOWSKI": 3}
_NEAREST = {"F1": 0, "F2": 1, "SMOOTH_F1": 2}


@kind("ShaderNodeTexNoise")
def noise(n: Reader) -> Outputs:
    """Noise in octaves."""
    n_axes = dimensions(n, "noise_dimensions")
    point = n.call("noise_point", n.literal(n_axes), *_at(n, n_axes), n.number("Distortion"))
    octaves = [n.number("Detail"), n.number("Roughness"), n.number("Lacunarity", 2.0)]
    type_ = n.setting("noise_type", "FBM")
    flags = [n.literal(bool(n.setting("normalize", True)))] if type_ == "FBM" else []
    name, given = _fractal(n, type_, n_axes, point, octaves, flags)
    color = n.call(f"{name}_color", *given)
    value = n.call("first_of", color) if n.is_used("Fac") and n.is_used("Color") else n.call(name, *given)
    return {"Fac": value, "Color": color}


@kind("ShaderNodeTexMusgrave")
def musgrave(n: Reader) -> Outputs:
    """Noise as Blender had it until 4.0: `Detail` counts the first octave too, and `Dimension` stands for roughness."""
    n_axes, type_ = dimensions(n, "musgrave_dimensions"), n.setting("musgrave_type", "FBM")
    point = n.call("noise_point", n.literal(n_axes), *_at(n, n_axes), n.value(0.0))
    detail, lacunarity = n.number("Detail"), n.call("musgrave_lacunarity", n.number("Lacunarity", 2.0))
    roughness = n.call("musgrave_roughness", n.number("Dimension"), lacunarity)
    octaves = [n.call("musgrave_detail", n.literal(type_ == "HETERO_TERRAIN"), detail), roughness, lacunarity]
    flags = [n.literal(False)] if type_ == "FBM" else []
    name, given = _fractal(n, type_, n_axes, point, octaves, flags)
    value = n.call(name, *given)
    if type_ in ("FBM", "HYBRID_MULTIFRACTAL", "MULTIFRACTAL"):
        value = n.call("musgrave_value", value, n.value(1.0 if type_ == "MULTIFRACTAL" else 0.0), detail)
    return {"Fac": value}


@kind("ShaderNodeTexVoronoi")
def voronoi(n: Reader) -> Outputs:
    """Cells around points."""
    n_axes, feature = dimensions(n, "voronoi_dimensions"), n.setting("feature", "F1")
    point = n.call("texture_point", n.literal(n_axes), *_at(n, n_axes))
    randomness = n.number("Randomness", 1.0)
    if feature == "N_SPHERE_RADIUS":
        return {"Radius": n.call("voronoi_radius", n.literal(n_axes), point, randomness)}
    octaves = [n.number("Detail"), n.number("Roughness", 0.5), n.number("Lacunarity", 2.0)]
    normalizes = n.literal(bool(n.setting("normalize", False)))
    if feature == "DISTANCE_TO_EDGE":
        return {"Distance": n.call("voronoi_edge", n.literal(n_axes), normalizes, point, *octaves, randomness)}
    metric = _METRICS[n.setting("distance", "EUCLIDEAN")] if n_axes > 1 else 0
    out = n.call("voronoi_nearest", *map(n.literal, (n_axes, metric, _NEAREST[feature])), normalizes, point,
                 n.number("Scale"), *octaves, n.number("Smoothness"), n.number("Exponent"), randomness)
    return {"Distance": out["distance"], "Color": out["color"], "Position": as_vector(out["position"]), "W": out["w"]}


def _at(n: Reader, n_axes: int) -> list[Expr]:
    """Coordinates of a texture of so many dimensions, and its scale."""
    at = n.value((0.0, 0.0, 0.0)) if n_axes == 1 else place(n)
    return [at, n.number("W") if n_axes in (1, 4) else n.value(0.0), n.number("Scale")]


def _fractal(n: Reader, type_: str, n_axes: int, point: Expr, octaves: Sequence[Expr],
             flags: Sequence[Expr]) -> tuple[str, list[Expr]]:
    """The function of a type of noise, and what it is given."""
    name, more = _TYPES[type_]
    return name, [n.literal(n_axes), point, *octaves, *map(n.number, more), *flags]
