# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps whose nodes say more than values can: their trees, baked into a table for each.

A table is of all directions, of the cone of a spot, or of the place on an area lamp. What a tree makes of other things
is what it is there: of the direction of an area lamp's light, that of its axis; of the place on a ball, its outermost
one. Object space is without the lamp's scale.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...gpu.device import Device
from ...nodes.sources import lamp_tree
from ...scene.types import Image, Light
from ..sources import light_of_points
from ..upload.lamps import Lamps, upload_lamps

ALL_DIRECTIONS = 256, 128  # texels; other tables are squares of SIDE
SIDE = 128
WIDE_SPOT = 0.17  # as in bind/lamp_tables.glsl


def make_lamps(device: Device, lights: tuple[Light, ...], images: tuple[Image, ...], centre: np.ndarray) -> Lamps:
    """All lamps on the device, positions relative to `centre`."""
    made, tables = [], list[np.ndarray | None]()
    for light in lights:
        table = None
        if not light.is_exact and light.graph is not None:
            tree = lamp_tree(light.graph)
            factors = light_of_points(device, tree.shine.tree, images, _points(light), 0, light.world_from_light)
            light, table = _with_table(light, factors)
        made.append(light)
        tables.append(table)
    return upload_lamps(device, tuple(made), centre, tables)


def _with_table(light: Light, factors: np.ndarray) -> tuple[Light, np.ndarray | None]:
    """The lamp as strong as in the mean of its points' factors (n, 3), and a table of what is left of them."""
    factors = np.maximum(factors, 0.0)
    mean = float(factors.mean()) if factors.any() else 0.0
    if light.kind == "SUN":
        r, g, b = (light.emitted * factors.astype("f8").mean(0)).tolist()
        return replace(light, emitted=(r, g, b)), None
    r, g, b = (np.array(light.emitted) * mean).tolist()
    width, height = _size(light)
    return replace(light, emitted=(r, g, b)), (factors / mean).reshape(height, width, 3) if mean else None


def _size(light: Light) -> tuple[int, int]:
    return ALL_DIRECTIONS if _is_round(light) else (1, 1) if light.kind == "SUN" else (SIDE, SIDE)


def _is_round(light: Light) -> bool:
    """Whether its table is of all directions."""
    return light.kind == "POINT" or (light.kind == "SPOT" and np.cos(light.spot_angle / 2) <= WIDE_SPOT)


def _points(light: Light) -> np.ndarray:
    """(n, 3, 4) f4 for `light_of_points`: the middles of the table's texels."""
    width, height = _size(light)
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    u, v = u.ravel(), v.ravel()
    away = _away(light, u, v)
    at = away * light.radius
    if light.kind == "AREA":
        at = np.stack([(u - 0.5) * light.size[0], (v - 0.5) * light.size[1], np.zeros_like(u)], 1)
    turn, middle = light.world_from_light[:3, :3], light.world_from_light[:3, 3]
    if light.kind == "SUN":
        at, middle = -away, np.zeros(3)
    points = np.zeros((len(u), 3, 4), "f4")
    points[:, 0, :3], points[:, 0, 3] = at @ turn.T + middle, 1.0
    points[:, 1, :3] = points[:, 2, :3] = away @ turn.T
    points[:, 1, 3], points[:, 2, 3] = _parametric(light, u, v, away)
    return points


def _away(light: Light, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Unit vectors (n, 3) f8 in the lamp's space: where its light goes to."""
    if _is_round(light):
        azimuth, latitude = (0.5 - u) * 2 * np.pi, (v - 0.5) * np.pi
        return np.stack([np.cos(latitude) * np.cos(azimuth), np.cos(latitude) * np.sin(azimuth), np.sin(latitude)], 1)
    if light.kind != "SPOT":
        return np.tile((0.0, 0.0, -1.0), (len(u), 1))
    tangent = np.tan(light.spot_angle / 2)
    away = np.stack([(2 * u - 1) * tangent, (2 * v - 1) * tangent, -np.ones_like(u)], 1)
    return away / np.linalg.norm(away, axis=1, keepdims=True)


def _parametric(light: Light, u: np.ndarray, v: np.ndarray, away: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What Cycles calls a lamp's UV: of a point lamp angles of the direction, of a sun its middle."""
    if light.kind == "POINT":
        return 0.5 - np.arctan2(away[:, 0], away[:, 1]) / (2 * np.pi), np.arccos(np.clip(-away[:, 2], -1, 1)) / np.pi
    if light.kind == "SPOT" and _is_round(light):
        across = 2 * max(np.tan(min(light.spot_angle, 3.1) / 2), 1e-6) * np.maximum(-away[:, 2], 1e-6)
        return 0.5 + away[:, 0] / across, 0.5 + away[:, 1] / across
    return u, v
