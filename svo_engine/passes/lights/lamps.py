# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps whose nodes say more than values can: their trees, baked into a table for each.

Everything that their trees see is in the lamp's own coordinates, without its scale. A table is of all directions, of the
cone of a spot, or of the place on an area lamp; so what depends on two of these counts by the mean that is looked at.
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
            light, table = _with_table(light, light_of_points(device, tree.shine.tree, images, _points(light), 0))  # noqa: PLW2901
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
    points = np.zeros((len(u), 3, 4), "f4")
    down = np.tile((0.0, 0.0, -1.0), (len(u), 1))
    if _is_round(light):
        azimuth, latitude = (0.5 - u) * 2 * np.pi, (v - 0.5) * np.pi
        away = np.stack([np.cos(latitude) * np.cos(azimuth), np.cos(latitude) * np.sin(azimuth), np.sin(latitude)], 1)
    elif light.kind == "SPOT":
        tangent = np.tan(light.spot_angle / 2)
        away = np.stack([(2 * u - 1) * tangent, (2 * v - 1) * tangent, -np.ones_like(u)], 1)
        away /= np.linalg.norm(away, axis=1, keepdims=True)
    else:
        away = down
    points[:, 0, :3] = away * light.radius
    if light.kind == "AREA":
        points[:, 0, 0], points[:, 0, 1] = (u - 0.5) * light.size[0], (v - 0.5) * light.size[1]
    points[:, 0, 3] = 1.0
    points[:, 1, :3], points[:, 2, :3] = away, away
    points[:, 1, 3], points[:, 2, 3] = u, v
    return points
