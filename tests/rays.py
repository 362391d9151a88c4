# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures by rays, small and unsmoothed, and closed forms to hold them against."""

from __future__ import annotations

from typing import Any

import numpy as np

from svo_engine.render import Session
from svo_engine.scene.types import Camera, Material, Scene, World
from tests import scenes
from tests.on_gpu import picture_of

# One ray a pixel through its very centre; the fewest rays everywhere else
RAYS = {"method": "rays", "cache_resolution": "32", "cache_rays": 4, "gather_rays": 4, "bounces": 12,
        "injection_samples": 1, "filter_width": 0.01, "denoise": False}

FLAT_WORLD = World((1.0, 1.0, 1.0))

TURN = scenes.look((0.3, 0.5, 0.4)) * (1, 1, 1, 0) + np.diag([0, 0, 0, 1])  # about no axis of the grid


def shot(session: Session, scene: Scene, **settings: Any) -> np.ndarray:
    """Radiance (height, width, 3) f8 by rays, some settings changed."""
    return picture_of(session, scene, **{**RAYS, **settings})[..., :3].astype("f8")


def glow(radiance: float, rho: float = 0.0) -> Material:
    """Sends out `radiance` and reflects the share `rho`, both grey and diffuse."""
    return Material("Glow", (rho, rho, rho), emission=(radiance, radiance, radiance), specular_level=0)


def above(side: float = 2.0, z: float = 5.0, size: tuple[int, int] = (32, 24)) -> Camera:
    """An orthographic camera that looks down from height z at a part of the floor `side` metres wide."""
    place = scenes.look((0, 0, z), (0, 0, 0), (0, 1, 0))
    return Camera("Above", place, size, is_orthographic=True, ortho_scale=side, clip_start=0.001)


def directions(camera: Camera) -> np.ndarray:
    """(height, width, 3) f8, unit: along which a perspective camera looks through its pixels' centres."""
    width, height = camera.size
    x = ((np.arange(width) + 0.5) / width - 0.5) * camera.sensor[0] / camera.lens
    y = ((np.arange(height) + 0.5) / width - 0.5 * height / width) * camera.sensor[0] / camera.lens
    d = np.stack([*np.meshgrid(x, y), np.full((height, width), -1.0)], -1) @ camera.world_from_camera[:3, :3].T
    return d / np.linalg.norm(d, axis=2, keepdims=True)


def floor_points(camera: Camera) -> np.ndarray:
    """(height, width, 3) f8: what the pixels' centres of a camera `above` see of the plane z = 0."""
    width, height = camera.size
    x = ((np.arange(width) + 0.5) / width - 0.5) * camera.ortho_scale
    y = ((np.arange(height) + 0.5) / width - 0.5 * height / width) * camera.ortho_scale
    return np.stack([*np.meshgrid(x, y), np.zeros((height, width))], -1)


def rectangle_share(p: np.ndarray, low: tuple[float, float], high: tuple[float, float], height: float) -> np.ndarray:
    """The part of the cosine-weighted hemisphere over points p (..., 3) of z = 0 that a level rectangle fills."""

    def corner(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        a, b = x / height, y / height
        s, t = np.sqrt(1 + a * a), np.sqrt(1 + b * b)
        return (a / s * np.arctan(b / s) + b / t * np.arctan(a / t)) / (2 * np.pi)

    left, right, bottom, top = low[0] - p[..., 0], high[0] - p[..., 0], low[1] - p[..., 1], high[1] - p[..., 1]
    return corner(right, top) - corner(left, top) - corner(right, bottom) + corner(left, bottom)
