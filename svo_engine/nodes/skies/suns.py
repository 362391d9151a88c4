# SPDX-License-Identifier: GPL-3.0-or-later
"""The suns of a world's Sky Textures: where they stand in the world, and which points of a disc stand for it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from ...scene.graph import Graph, Link, Node
from .tables import Disc, disc_of

RINGS, SPOKES = 6, 12
LIMB = 0.6  # how much darker the edge of the sun's disc is than its middle


@dataclass(frozen=True)
class PlacedSun:
    """axis: unit vector to the disc's middle, world space; disc: as the node has it."""

    axis: tuple[float, float, float]
    disc: Disc

    @property
    def radius(self) -> float:
        """Radians."""
        return self.disc.size / 2

    def directions(self) -> tuple[np.ndarray, np.ndarray]:
        """Unit vectors (n, 3) to points of equal solid angle on the disc, and their angles from its middle over its
        radius, (n,)."""
        shares = (np.arange(RINGS) + 0.5) / RINGS
        angles = np.repeat(2 * np.arcsin(np.sqrt(shares) * np.sin(self.radius / 2)), SPOKES)
        turns = np.tile(np.arange(SPOKES) * 2 * np.pi / SPOKES, RINGS) + np.repeat(np.arange(RINGS), SPOKES)
        axis = np.array(self.axis)
        side = np.cross(axis, (0.0, 0.0, 1.0) if abs(axis[2]) < 0.9 else (1.0, 0.0, 0.0))
        side /= np.linalg.norm(side)
        around = np.cos(turns)[:, None] * side + np.sin(turns)[:, None] * np.cross(axis, side)
        return np.cos(angles)[:, None] * axis + np.sin(angles)[:, None] * around, angles / self.radius


def limb(share: np.ndarray) -> np.ndarray:
    """Brightness over that of the disc's middle, at shares of its radius."""
    return 1 - LIMB * (1 - np.sqrt(np.maximum(1 - share**2, 0.0)))


def suns_of(graph: Graph, warn: Callable[[str], object]) -> tuple[PlacedSun, ...]:
    """The discs of all Sky Textures, each where the mapping before its node puts it."""
    found: dict[PlacedSun, None] = {}
    for nodes in (graph.nodes, *(group.nodes for group in graph.groups.values())):
        for node in nodes:
            disc = disc_of(node.settings) if node.kind == "ShaderNodeTexSky" and node.through is None else None
            if disc and max(disc.ends[0] + disc.ends[1]) > 0:
                turned = np.linalg.pinv(_lookup(nodes, node, warn)) @ disc.sun.direction
                length = max(float(np.linalg.norm(turned)), 1e-8)
                x, y, z = (turned / length).tolist()
                found[PlacedSun((x, y, z), disc)] = None
    return tuple(found)


def _lookup(nodes: tuple[Node, ...], node: Node, warn: Callable[[str], object]) -> np.ndarray:
    """Matrix (3, 3) from directions in the world to what the node looks up, for Mapping nodes by constants."""
    matrix = np.eye(3)
    for before in _before(nodes, node):
        if before.kind == "ShaderNodeMapping" and not any(isinstance(v, Link) for k, v in before.inputs.items()
                                                          if k != "Vector"):
            matrix = matrix @ _mapped(before)
        elif before.kind not in ("ShaderNodeTexCoord", "ShaderNodeNewGeometry", "NodeReroute"):
            warn(f"node '{node.name}': its sun's disc stands where it would without node '{before.name}'")
    return matrix


def _before(nodes: tuple[Node, ...], node: Node) -> Iterator[Node]:
    """The chain of nodes that makes the node's vector."""
    for _ in range(len(nodes)):
        inputs = node.inputs
        link = inputs.get("Vector") if node.kind != "NodeReroute" else next(iter(inputs.values()), None)
        if not isinstance(link, Link):
            return
        node = nodes[link.node]
        if node.through is None:
            yield node


def _mapped(node: Node) -> np.ndarray:
    """Matrix (3, 3) of a Mapping node, without its location."""
    rotation, scale = (np.array(node.inputs.get(name, default), "f8")
                       for name, default in (("Rotation", (0, 0, 0)), ("Scale", (1, 1, 1))))
    (cx, cy, cz), (sx, sy, sz) = np.cos(rotation), np.sin(rotation)
    x = np.array(((1, 0, 0), (0, cx, -sx), (0, sx, cx)))
    y = np.array(((cy, 0, sy), (0, 1, 0), (-sy, 0, cy)))
    z = np.array(((cz, -sz, 0), (sz, cz, 0), (0, 0, 1)))
    turn = z @ y @ x
    kind = node.settings.get("vector_type", "POINT")
    inverse = np.divide(1.0, scale, out=np.zeros(3), where=scale != 0)
    if kind == "TEXTURE":
        return inverse[:, None] * turn.T
    return turn * (inverse if kind == "NORMAL" else scale)
