# SPDX-License-Identifier: GPL-3.0-or-later
"""The suns of a world's Sky Textures, and which points of a disc stand for it."""

from __future__ import annotations

import numpy as np

from ...scene.graph import Graph
from .tables import Disc, disc_of

RINGS, SPOKES = 6, 12
LIMB = 0.6  # how much darker the edge of the sun's disc is than its middle


def points_on(disc: Disc) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors (n, 3) to points of equal solid angle on the disc, and their angles from its middle over its radius,
    (n,).
    """
    shares = (np.arange(RINGS) + 0.5) / RINGS
    radius = disc.size / 2
    angles = np.repeat(2 * np.arcsin(np.sqrt(shares) * np.sin(radius / 2)), SPOKES)
    turns = np.tile(np.arange(SPOKES) * 2 * np.pi / SPOKES, RINGS) + np.repeat(np.arange(RINGS), SPOKES)
    axis = disc.sun.direction
    side = np.cross(axis, (0.0, 0.0, 1.0) if abs(axis[2]) < 0.9 else (1.0, 0.0, 0.0))
    side /= np.linalg.norm(side)
    around = np.cos(turns)[:, None] * side + np.sin(turns)[:, None] * np.cross(axis, side)
    return np.cos(angles)[:, None] * axis + np.sin(angles)[:, None] * around, angles / radius


def limb(share: np.ndarray) -> np.ndarray:
    """Brightness over that of the disc's middle, at shares of its radius."""
    return 1 - LIMB * (1 - np.sqrt(np.maximum(1 - share**2, 0.0)))


def suns_of(graph: Graph) -> tuple[Disc, ...]:
    """The discs of all Sky Textures that shine. Blender turns no sky that has a disc."""
    nodes = (*graph.nodes, *(node for group in graph.groups.values() for node in group.nodes))
    found = (disc_of(node.settings) for node in nodes if node.kind == "ShaderNodeTexSky" and node.through is None)
    return tuple(dict.fromkeys(disc for disc in found if disc and max(disc.ends[0] + disc.ends[1]) > 0))
