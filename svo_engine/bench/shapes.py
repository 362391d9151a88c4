# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes made of numbers, of any size: a white room, a bumpy ball, many lamps, many placings. Metres, Z up."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..scene.meshes import make_mesh
from ..scene.types import Camera, Instances, Light, Material, Mesh, Scene

WHITE = Material("White", (0.8, 0.8, 0.8), specular_level=0)
RED = Material("Red", (0.8, 0.1, 0.1), specular_level=0)
GREEN = Material("Green", (0.1, 0.8, 0.1), specular_level=0)
POWER = 5.0  # W sr^-1 of all lamps together


def bumpy_ball(n_triangles: int, radius: float = 0.5) -> Mesh:
    """A smooth-shaded ball with waves on it, of about `n_triangles` triangles, around the origin."""
    n = max(int(np.sqrt(n_triangles / 4)), 3)
    theta, phi = np.meshgrid(np.linspace(0, np.pi, n + 1), np.linspace(0, 2 * np.pi, 2 * n + 1), indexing="ij")
    wave = radius * (1 + 0.1 * np.sin(5 * theta) ** 2 * np.sin(7 * phi))
    unit = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1)
    first = (np.arange(n)[:, None] * (2 * n + 1) + np.arange(2 * n)).ravel()
    below = first + 2 * n + 1
    triangles = np.concatenate([np.stack([first, below, below + 1], 1), np.stack([first, below + 1, first + 1], 1)])
    flat = unit.reshape(-1, 3).astype("f4")
    uvs = np.stack([phi / (2 * np.pi), theta / np.pi], -1).reshape(-1, 2)
    return make_mesh("Ball", (unit * wave[..., None]).reshape(-1, 3), triangles, corner_normals=flat[triangles],
                     corner_uvs=uvs[triangles])[0]


def hall(n_triangles: int = 5000, n_lamps: int = 1, n_balls: int = 1) -> Scene:
    """A white room of 2 m, open towards -y, in which balls of `n_triangles` triangles each float under small lamps.

    The balls fill the same cube and the lamps share the same power, however many there are.
    """
    side = int(np.ceil(round(n_balls ** (1 / 3), 6)))
    cells = np.stack(np.unravel_index(np.arange(n_balls), (side, side, side)), 1)
    places = np.tile(np.eye(4), (n_balls + 1, 1, 1))
    places[1:, :3, :3] /= side
    places[1:, :3, 3] = ((cells + 0.5) / side - 0.5) * 1.4 + (0, 0, 0.9)
    first_slot = np.array([0, *range(3, n_balls + 4)], "u4")
    instances = Instances(("Room", *["Ball"] * n_balls), np.array([0, *[1] * n_balls], "u4"), places, first_slot,
                          np.zeros(first_slot[-1], "u4"))
    camera = np.array([[1, 0, 0, 0], [0, 0, -1, -4.2], [0, 1, 0, 1], [0, 0, 0, 1]], "f8")
    return Scene((_room(), bumpy_ball(n_triangles)), instances, (WHITE,), lights=_lamps(n_lamps),
                 camera=Camera("Camera", camera, (800, 600), lens=40))


def cornell(ball: Material = WHITE, **more: Any) -> Scene:
    """The same room with a red and a green wall and a ball of `ball`; `more` are fields of Scene."""
    scene = hall(n_triangles=2000)
    inst = replace(scene.instances, first_slot=np.array([0, 3, 4], "u4"), slot_materials=np.arange(4, dtype="u4"))
    return replace(scene, instances=inst, materials=(WHITE, RED, GREEN, ball), **more)


def _room() -> Mesh:
    """Five walls of a box from (-1, -1, 0) to (1, 1, 2), without the one at y = -1; normals inwards. The left and the
    right one have slots of their own."""
    corners = np.array([[x, y, z] for z in (0, 2) for y in (-1, 1) for x in (-1, 1)], "f4")
    walls = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    return make_mesh("Room", corners, np.concatenate([walls[:, :3], walls[:, [0, 2, 3]]]),
                     material_slots=np.tile([0, 0, 0, 1, 2], 2))[0]


def _lamps(n: int) -> tuple[Light, ...]:
    """Small spheres in a square grid under the ceiling."""
    side = int(np.ceil(np.sqrt(n)))
    lamps = []
    for i in range(n):
        matrix = np.eye(4)
        matrix[:3, 3] = (i % side + 0.5) / side * 1.8 - 0.9, (i // side + 0.5) / side * 1.8 - 0.9, 1.9
        power = POWER / n
        lamps.append(Light(f"Lamp {i}", "POINT", matrix, (power, power, power), radius=0.02))
    return tuple(lamps)
