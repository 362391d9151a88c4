# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes to trace rays through, and points on their surfaces."""

from __future__ import annotations

import numpy as np

from svo_engine.scene.meshes import make_mesh
from svo_engine.scene.types import Scene
from tests import scenes
from tests.tracing import Traced


def many_balls() -> Scene:
    """A room with 30 bumpy balls that are one mesh of 288,120 triangles."""
    rng, ball = np.random.default_rng(0), scenes.sphere("Ball", 1.0, 49)
    corners, triangles, n = [], [], len(ball.positions)
    for i in range(30):
        bumps = 1 + 0.1 * np.sin(9 * ball.positions @ rng.normal(size=(3, 3))).sum(1, keepdims=True)
        at = rng.uniform((-0.8, -0.8, 0.2), (0.8, 0.8, 1.8))
        corners.append(ball.positions * bumps * rng.uniform(0.1, 0.25) + at)
        triangles.append(ball.triangles + i * n)
    mesh = make_mesh("Balls", np.concatenate(corners), np.concatenate(triangles))[0]
    return scenes.cornell(things=(scenes.Thing(mesh),))


def seen_points(traced: Traced, n: int) -> np.ndarray:
    """n points that the camera sees, evenly over their surfaces and in random order, (n, 2, 4) f4: position, metres
    relative to the scene's centre, and unit normal of the side that is seen.
    """
    rng, eye, corners = np.random.default_rng(1), _eye(traced), _corners(traced)
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    kept: list[np.ndarray] = []
    while sum(map(len, kept)) < n:
        a, b, c = np.moveaxis(corners[rng.choice(len(area), 65536, p=area / area.sum())], 1, 0)
        u, v = rng.random((2, len(a), 1))
        u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
        rows = np.zeros((len(a), 2, 4), "f4")
        rows[:, 0, :3] = a + u * (b - a) + v * (c - a)
        across, d = np.cross(b - a, c - a), rows[:, 0, :3] - eye
        rows[:, 1, :3] = across / np.linalg.norm(across, axis=1, keepdims=True)
        rows[:, 1, :3] *= np.where((across * d).sum(1, keepdims=True) < 0, 1, -1)
        kept.append(rows[~traced.any(np.broadcast_to(eye, d.shape), d, 1 - 1e-4)])
    return np.concatenate(kept)[:n]


def _eye(traced: Traced) -> np.ndarray:
    camera = traced.gpu_scene.scene.camera
    assert camera
    return camera.world_from_camera[:3, 3] - traced.gpu_scene.centre_ws


def _corners(traced: Traced) -> np.ndarray:
    """(n_triangles, 3, 3) f8 of all instances, metres relative to the scene's centre."""
    scene = traced.gpu_scene.scene
    return np.concatenate([
        scene.meshes[m].positions[scene.meshes[m].triangles].astype("f8") @ place[:3, :3].T + place[:3, 3]
        for m, place in zip(scene.instances.mesh, scene.instances.world_from_object, strict=True)
    ]) - traced.gpu_scene.centre_ws
