# SPDX-License-Identifier: GPL-3.0-or-later
"""Small scenes for tests, built from numbers alone. Metres, world space, Z up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from svo_engine.scene.camera import make_view
from svo_engine.scene.meshes import make_mesh
from svo_engine.scene.types import Camera, Instances, Light, LightKind, Material, Mesh, Scene, View, World
from svo_engine.settings import RenderSettings

Vec = Sequence[float]

# Quick on a processor, and what the passes made, unsmoothed
SMALL = RenderSettings(method="cones", samples=1, resolution="32", denoise=False)

# Nothing but diffuse reflection, so that closed forms hold
WHITE = Material("White", (0.8, 0.8, 0.8), specular_level=0)
BLACK = Material("Black", (0, 0, 0), specular_level=0)
RED = Material("Red", (0.8, 0.1, 0.1), specular_level=0)
GREEN = Material("Green", (0.1, 0.8, 0.1), specular_level=0)

# A little of everything
GLOSSY = Material("Glossy", (0.7, 0.5, 0.3), roughness=0.2, metallic=0.5, emission=(0.1, 0, 0))


@dataclass(frozen=True, eq=False)
class Thing:
    """One mesh, its material, and where it is placed: (4, 4) each."""

    mesh: Mesh
    material: Material = WHITE
    places: tuple[np.ndarray, ...] = (np.eye(4),)


def scene(*things: Thing, **more: Any) -> Scene:
    """A Scene of `things`; `more` are fields of Scene."""
    materials = tuple(dict.fromkeys(thing.material for thing in things))
    placed = [(i, thing, place) for i, thing in enumerate(things) for place in thing.places]
    instances = Instances(
        tuple(thing.mesh.name for _, thing, _ in placed), np.array([i for i, _, _ in placed], "u4"),
        np.array([place for *_, place in placed], "f8").reshape(-1, 4, 4), np.arange(len(placed) + 1, dtype="u4"),
        np.array([materials.index(thing.material) for _, thing, _ in placed], "u4"))
    return Scene(tuple(thing.mesh for thing in things), instances, materials, **more)


def quad(name: str, corner: Vec, u: Vec, v: Vec, n: int = 1, uvs: bool = False) -> Mesh:
    """A parallelogram of 2 n^2 triangles from `corner` along u and v, its normal along u x v."""
    a, b = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
    st = np.stack([a.ravel(), b.ravel()], 1)
    i = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    triangles = np.concatenate([np.stack([i, i + 1, i + n + 2], 1), np.stack([i, i + n + 2, i + n + 1], 1)])
    positions = np.array(corner) + st @ np.array([u, v], "f8")
    return make_mesh(name, positions, triangles, corner_uvs=st[triangles] if uvs else None)[0]


def box(name: str, low: Vec, high: Vec) -> Mesh:
    """A closed box, normals outwards."""
    corners = np.array([[(low, high)[b][axis] for axis, b in enumerate((i & 1, i >> 1 & 1, i >> 2))] for i in range(8)])
    faces = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
    return make_mesh(name, corners, np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]]))[0]


def sphere(name: str, radius: float = 1.0, n: int = 16) -> Mesh:
    """A smooth sphere of 4 n^2 triangles around the origin, without those that have no area."""
    theta, phi = np.meshgrid(np.linspace(0, np.pi, n + 1), np.linspace(0, 2 * np.pi, 2 * n + 1), indexing="ij")
    unit = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1).reshape(-1, 3)
    i = (np.arange(n)[:, None] * (2 * n + 1) + np.arange(2 * n)).ravel()
    down = i + 2 * n + 1
    triangles = np.concatenate([np.stack([i, down, down + 1], 1), np.stack([i, down + 1, i + 1], 1)])
    return make_mesh(name, radius * unit, triangles, corner_normals=unit[triangles])[0]


def floor(side: float = 2.0, n: int = 1) -> Mesh:
    """A square in z = 0 around the origin, its normal up."""
    return quad("Floor", (-side / 2, -side / 2, 0), (side, 0, 0), (0, side, 0), n)


def look(eye: Vec, target: Vec = (0, 0, 0), up: Vec = (0, 0, 1)) -> np.ndarray:
    """world_from_camera, or world_from_light: at `eye`, looking along -Z at `target`."""
    z = np.subtract(eye, target) / np.linalg.norm(np.subtract(eye, target))
    x = np.cross(up, z) / np.linalg.norm(np.cross(up, z))
    m = np.eye(4)
    m[:3, 0], m[:3, 1], m[:3, 2], m[:3, 3] = x, np.cross(z, x), z, eye
    return m


def moved(x: float = 0, y: float = 0, z: float = 0) -> np.ndarray:
    """A translation (4, 4)."""
    m = np.eye(4)
    m[:3, 3] = x, y, z
    return m


def lamp(kind: LightKind, eye: Vec, target: Vec = (0, 0, 0), emitted: float = 1.0, **more: Any) -> Light:
    """A grey lamp at `eye` that shines at `target`."""
    target = target if tuple(target) != tuple(eye) else (eye[0], eye[1], eye[2] - 1)
    up = (0, 1, 0) if np.allclose(np.cross(np.subtract(eye, target), (0, 0, 1)), 0) else (0, 0, 1)
    return Light(kind.title(), kind, look(eye, target, up), (emitted, emitted, emitted), **more)


def room() -> tuple[Thing, ...]:
    """A box 2 m wide, open towards -y, with a red and a green wall and a block."""
    return (
        Thing(floor()),
        Thing(quad("Ceiling", (-1, -1, 2), (0, 2, 0), (2, 0, 0))),
        Thing(quad("Back", (-1, 1, 0), (2, 0, 0), (0, 0, 2))),
        Thing(quad("Left", (-1, -1, 0), (0, 2, 0), (0, 0, 2)), RED),
        Thing(quad("Right", (1, -1, 0), (0, 0, 2), (0, 2, 0)), GREEN),
        Thing(box("Block", (-0.6, -0.1, 0), (0, 0.5, 0.9))))


def cornell(*lights: Light, things: tuple[Thing, ...] = (), **more: Any) -> Scene:
    """The room with `things` in it, seen from its open side; one small lamp by default."""
    camera = Camera("Camera", look((0, -4.2, 1), (0, 0, 1)), (64, 48), lens=40)
    lights = lights or (lamp("POINT", (0.2, -0.3, 1.7), emitted=5.0, radius=0.05),)
    return scene(*room(), *things, **{"camera": camera, "lights": lights, **more})


def rich() -> Scene:
    """The room with every kind of lamp, a glossy ball twice, and a sky."""
    balls = (moved(0.5, 0.2, 0.25), moved(0.6, -0.4, 0.25))
    return cornell(
        lamp("POINT", (0.4, -0.3, 1.7), emitted=2.0, radius=0.1),
        lamp("SPOT", (-0.5, -0.9, 1.5), (0, 0, 0), emitted=3.0, spot_angle=1.0, spot_blend=0.3, radius=0.05),
        lamp("AREA", (0, 0, 1.9), emitted=4.0, size=(0.5, 0.3), spread=2.0),
        lamp("SUN", (1, -3, 2), emitted=0.5, angle=0.01),
        things=(Thing(sphere("Ball", 0.25, 8), GLOSSY, balls),), world=World((0.1, 0.2, 0.3)))


def view(of: Scene, **more: Any) -> View:
    """What the scene's own camera sees."""
    assert of.camera is not None
    return make_view(of.camera, **more)
