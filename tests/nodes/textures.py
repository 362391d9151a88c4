# SPDX-License-Identifier: GPL-3.0-or-later
"""Every mode of every texture that is computed, as cases of `lookups`."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Any

from tests.nodes.lookups import Case

T = "ShaderNodeTex"
DIMENSIONS = ("1D", "2D", "3D", "4D")
GRADIENTS = ("LINEAR", "QUADRATIC", "EASING", "DIAGONAL", "SPHERICAL", "QUADRATIC_SPHERE", "RADIAL")
FRACTALS = {"FBM": {}, "MULTIFRACTAL": {}, "HETERO_TERRAIN": {"Offset": 0.7},
            "HYBRID_MULTIFRACTAL": {"Offset": 0.7, "Gain": 1.7}, "RIDGED_MULTIFRACTAL": {"Offset": 0.7, "Gain": 1.7}}
METRICS = ("EUCLIDEAN", "MANHATTAN", "CHEBYCHEV", "MINKOWSKI")
MAPPING = {"texture_mapping.translation": (0.3, -0.2, 0.1), "texture_mapping.rotation": (0.3, 0.5, -0.4),
           "texture_mapping.scale": (1.5, 0.7, -0.8)}
COLORS = {"Color1": (0.8, 0.1, 0.2, 1.0), "Color2": (0.1, 0.7, 0.3, 1.0), "Mortar": (0.05, 0.1, 0.9, 1.0)}


def patterns() -> Iterator[Case]:
    """Checkers, gradients, magic, bricks, white noise."""
    yield Case(f"{T}Checker", ("Color", "Fac"), {}, {"Scale": 3.7})
    yield from (Case(f"{T}Gradient", ("Fac", "Color"), {"gradient_type": kind}) for kind in GRADIENTS)
    for depth in range(11):
        yield Case(f"{T}Magic", ("Color", "Fac"), {"turbulence_depth": depth}, {"Scale": 1.3, "Distortion": 1.2})
    yield from (Case(f"{T}Magic", ("Color",), {}, {"Scale": 1.3, "Distortion": x}) for x in (0.0, -2.0))
    rows = {"offset": 0.3, "offset_frequency": 3, "squash": 1.5, "squash_frequency": 2}
    sizes = {"Scale": 3.0, "Mortar Size": 0.03, "Bias": 0.1, "Brick Width": 0.6, "Row Height": 0.3}
    for smooth in (0.0, 0.5):
        yield Case(f"{T}Brick", ("Color", "Fac"), rows, {**COLORS, **sizes, "Mortar Smooth": smooth})
    yield Case(f"{T}Brick", ("Color", "Fac"))
    yield from (Case(f"{T}WhiteNoise", ("Value", "Color"), {"noise_dimensions": d}) for d in DIMENSIONS)


def waves() -> Iterator[Case]:
    """Bands and rings in all directions and profiles, and Gabor's."""
    for way, profile in (("X", "SIN"), ("Y", "SAW"), ("Z", "TRI"), ("DIAGONAL", "SIN")):
        shape = {"wave_type": "BANDS", "bands_direction": way, "wave_profile": profile}
        yield Case(f"{T}Wave", ("Fac", "Color"), shape, {"Scale": 0.73, "Phase Offset": 0.4})
    moved = {"Distortion": 2.5, "Detail": 2.5, "Detail Scale": 1.5, "Detail Roughness": 0.6}
    for way, profile in (("X", "SIN"), ("Y", "SIN"), ("Z", "TRI"), ("SPHERICAL", "SIN")):
        shape = {"wave_type": "RINGS", "rings_direction": way, "wave_profile": profile}
        yield Case(f"{T}Wave", ("Fac",), shape, {"Scale": 0.73, **moved})
    for kind in ("2D", "3D"):
        for anisotropy in (1.0, 0.3):
            given = {"Scale": 1.7, "Frequency": 2.5, "Anisotropy": anisotropy}
            yield Case(f"{T}Gabor", ("Value", "Phase", "Intensity"), {"gabor_type": kind}, given)


def noises() -> Iterator[Case]:
    """All types of noise in all dimensions, and the mapping that nodes have of their own."""
    octaves = {"Scale": 1.3, "Detail": 2.6, "Roughness": 0.6, "Lacunarity": 2.1, "Distortion": 0.4}
    for d in DIMENSIONS:
        for kind, more in FRACTALS.items():
            yield Case(f"{T}Noise", ("Color",), {"noise_dimensions": d, "noise_type": kind}, {**octaves, **more})
        yield Case(f"{T}Noise", ("Fac",), {"noise_dimensions": d, "normalize": False}, {"Scale": 1.3, "Detail": 3.0})
        for detail in (0.0, 15.0):
            yield Case(f"{T}Noise", ("Fac",), {"noise_dimensions": d}, {"Detail": detail})
        yield Case(f"{T}Noise", ("Fac",), {"noise_dimensions": d}, {"Scale": 1e6, "Detail": 0.0})
    yield Case(f"{T}Noise", ("Fac", "Color"))
    for kind in ("POINT", "TEXTURE", "VECTOR", "NORMAL"):
        yield Case(f"{T}Noise", ("Fac",), {**MAPPING, "texture_mapping.vector_type": kind}, {"Scale": 1.3})
    axes = {f"texture_mapping.mapping_{a}": b for a, b in zip("xyz", ("Z", "NONE", "X"), strict=True)}
    yield Case(f"{T}Noise", ("Fac",), {**MAPPING, **axes}, {"Scale": 1.3})
    yield Case(f"{T}Noise", ("Fac",), {"texture_mapping.vector_type": "TEXTURE", "texture_mapping.scale": (0, 1, 1)})


def cells() -> Iterator[Case]:
    """Voronoi's, with all features and metrics in all dimensions."""
    octaves = {"Scale": 1.3, "Detail": 1.4, "Roughness": 0.6, "Lacunarity": 2.1, "Randomness": 0.9}
    for d in DIMENSIONS:
        places: tuple[str, ...] = {"1D": ("W",), "4D": ("Position", "W")}.get(d, ("Position",))
        shape: dict[str, Any] = {"voronoi_dimensions": d}
        for feature in ("F1", "F2", "SMOOTH_F1"):
            given = {**octaves, **({"Smoothness": 0.7} if feature == "SMOOTH_F1" else {})}
            outputs = ("Distance", "Color", *places)
            yield Case(f"{T}Voronoi", outputs, {**shape, "feature": feature, "normalize": feature != "F1"}, given)
            for metric in METRICS[1:] if d != "1D" else ():
                more = {"Exponent": 0.6} if metric == "MINKOWSKI" else {}
                yield Case(f"{T}Voronoi", ("Distance", "Color"), {**shape, "feature": feature, "distance": metric},
                           {"Scale": 1.3, **more})
        yield Case(f"{T}Voronoi", ("Distance",), {**shape, "feature": "SMOOTH_F1"}, {"Smoothness": 0.0})
        yield Case(f"{T}Voronoi", ("Distance",), {**shape, "feature": "DISTANCE_TO_EDGE", "normalize": True}, octaves)
        yield Case(f"{T}Voronoi", ("Distance",), {**shape, "feature": "DISTANCE_TO_EDGE"}, {"Scale": 1.3})
        yield Case(f"{T}Voronoi", ("Radius",), {**shape, "feature": "N_SPHERE_RADIUS"}, {"Scale": 1.3})
        yield Case(f"{T}Voronoi", ("Distance", "Color"), shape, {"Scale": 1.3, "Detail": 3.0, "Roughness": 0.0})


TILING = "ShaderNodeRadialTiling"
TILES = ("Segment Coordinates", "Segment ID", "Segment Width", "Segment Rotation")


def tiles() -> Iterator[Case]:
    """Segments of polygons: whole and broken numbers of sides; two sides are never partly round, where Cycles divides
    by what is left of zero."""
    for normalize in (False, True):
        for sides, roundness in itertools.product((2.0, 3.0, 5.0, 2.5, 4.3), (0.0, 0.3, 1.0)):
            if (sides, roundness) != (2.0, 0.3):
                yield Case(TILING, TILES, {"normalize": normalize}, {"Sides": sides, "Roundness": roundness})


FAMILIES = {"patterns": patterns, "waves": waves, "noises": noises, "cells": cells, "tiles": tiles}

HOSTILE = (0.0, -1.7, 1e6, 1e30, -1e30, 3e38, float("inf"), float("nan"))

_SANE = {"Scale": 1.1, "Detail": 4.5, "Roughness": 0.6, "Lacunarity": 2.0, "Offset": 0.5, "Gain": 1.0,
         "Distortion": 0.5, "Exponent": 0.5, "Randomness": 1.0, "Smoothness": 1.0}
_OCTAVES = ("Scale", "Detail", "Roughness", "Lacunarity", "Offset", "Gain", "Distortion")
_CELLS = ("Scale", "Lacunarity", "Exponent", "Randomness", "Smoothness")
_BRICKS = {"Scale": 3.0, "Mortar Size": 0.1, "Mortar Smooth": 0.1, "Bias": 0.0, "Brick Width": 0.5, "Row Height": 0.25}
_GABOR = {"Scale": 2.0, "Frequency": 2.0, "Anisotropy": 0.5}
_WAVE = {"Scale": 2.0, "Distortion": 2.0, "Detail": 2.0, "Detail Scale": 1.0, "Phase Offset": 0.0}


def hostile(value: float) -> Iterator[Case]:
    """Textures with a number in their inputs that nobody should give them."""
    for given in (dict.fromkeys(_OCTAVES, value), *({**_SANE, name: value} for name in _OCTAVES)):
        yield Case(f"{T}Noise", ("Fac",), {"noise_type": "HYBRID_MULTIFRACTAL"}, given)
        yield Case(f"{T}Noise", ("Color",), {}, given)
    for name in _CELLS:
        shape, given = {"distance": "MINKOWSKI", "normalize": True}, {**_SANE, name: value}
        for feature in ("F1", "SMOOTH_F1"):
            yield Case(f"{T}Voronoi", ("Distance", "Color", "Position"), {**shape, "feature": feature}, given)
        yield Case(f"{T}Voronoi", ("Distance",), {**shape, "feature": "DISTANCE_TO_EDGE"}, given)
    yield Case(f"{T}Voronoi", ("Radius",), {"feature": "N_SPHERE_RADIUS"}, {"Scale": value})
    for name in _BRICKS:
        yield Case(f"{T}Brick", ("Color", "Fac"), {}, {**COLORS, **_BRICKS, name: value})
    for name in _GABOR:
        for up in ((0.0, 0.0, 1.0), (0.0, 0.0, 0.0)):
            yield Case(f"{T}Gabor", ("Value", "Phase", "Intensity"), {"gabor_type": "3D"},
                       {**_GABOR, "Orientation 3D": up, name: value})
        yield Case(f"{T}Gabor", ("Value", "Phase", "Intensity"), {}, {**_GABOR, name: value})
    yield from (Case(f"{T}Wave", ("Fac",), {}, {**_WAVE, name: value}) for name in _WAVE)
    for given in ({"Scale": value, "Distortion": 2.0}, {"Scale": 2.0, "Distortion": value}):
        yield Case(f"{T}Magic", ("Color",), {"turbulence_depth": 10}, given)
    yield Case(f"{T}Checker", ("Fac",), {}, {"Scale": value})
    for normalize in (False, True):
        yield Case(TILING, TILES, {"normalize": normalize}, {"Sides": value, "Roundness": 0.3})
        yield Case(TILING, TILES, {"normalize": normalize}, {"Sides": 5.3, "Roundness": value})
