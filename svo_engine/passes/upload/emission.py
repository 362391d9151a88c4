# SPDX-License-Identifier: GPL-3.0-or-later
"""What materials send out. It stays while all else of materials is edited."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...nodes.traits import Traits
from ...scene import layouts
from ...scene.types import Color, Image, Material, Texture
from .looks import Looks
from .pictures import Pictures
from .sky import linear_pixels

# Radiance and its texture, alpha and its texture
Given = tuple[tuple[Color, int, float, int], ...]

_NONE = ((0.0, 0.0, 0.0), -1, 1.0, -1)


@dataclass(frozen=True, eq=False)
class Emission:
    """read: what bind/emission.glsl reads.

    means     (n_materials,) f8, mean radiance over colours and images; 1 of trees that shine
    highest   radiance, of all materials
    of_trees  (n_work,) f4, mean radiance of triangles whose material is a tree, if any of them shines; n_work counts
              triangles with instances
    is_tree   (n_materials,) bool: materials whose triangles stand in `of_trees`
    """

    scope: GpuScope
    read: Resources
    means: np.ndarray
    highest: float
    of_trees: np.ndarray | None
    is_tree: np.ndarray


def emissions_of(materials: tuple[Material, ...], traits: tuple[Traits | None, ...]) -> Given:
    """What each material sends out. What sends out nothing, or is a tree, is all the same."""
    return tuple((m.emission, m.emission_texture, m.alpha, m.alpha_texture) if t is None and max(m.emission) > 0
                 else _NONE for m, t in zip(materials, traits, strict=True))


def upload_emission(device: Device, pictures: Pictures, given: Given, textures: tuple[Texture, ...],
                    images: tuple[Image, ...], looks: Looks | None) -> Emission:
    """looks: what was baked, if any tree shines."""
    scope = device.scope()
    rows = np.zeros(len(given), layouts.dtype(layouts.EMISSION))
    for row, (color, color_texture, alpha, alpha_texture) in zip(rows, given, strict=True):
        row["color"], row["color_texture"], row["alpha"], row["alpha_texture"] = (color, color_texture, alpha,
                                                                                 alpha_texture)
    means = np.array([_mean(one, textures, images) for one in given], "f8")
    highest = max((_bound(one, textures, images) for one in given), default=0.0)
    baked: Resources = {"u_baked": None, "u_n_rows": 0}
    of_trees, is_tree = None, np.zeros(len(given), bool)
    if looks is not None:
        baked, of_trees, is_tree = looks.baked, looks.means, looks.emits
        highest, means = max(highest, looks.brightest), np.where(is_tree, 1.0, means)
    read = {**pictures.read, **baked, "Emissions": scope.buffer("emissions", rows)}
    return Emission(scope, read, means, highest, of_trees, is_tree)


def _mean(given: tuple[Color, int, float, int], textures: tuple[Texture, ...], images: tuple[Image, ...]) -> float:
    """Mean over the colours and, if it has one, over the emission's image."""
    emission, texture, alpha, _ = given
    color = np.array(emission, "f8")
    if texture >= 0:
        color *= linear_pixels(images[textures[texture].image])[..., :3].mean((0, 1))
    return max(float(color.mean()) * alpha, 0.0)


def _bound(given: tuple[Color, int, float, int], textures: tuple[Texture, ...], images: tuple[Image, ...]) -> float:
    """The highest radiance that it can send out: the unit of fixed-point sums."""
    bound, texture = max(given[0]), given[1]
    if bound > 0 and texture >= 0:
        pixels = images[textures[texture].image].pixels
        bound *= 1.0 if pixels.dtype == np.uint8 else float(pixels.max(initial=0.0))
    return max(bound, 0.0)
