# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps on the device."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...gpu.buffer import Buffer
from ...gpu.device import Device
from ...gpu.scope import GpuScope
from ...scene import layouts
from ...scene.types import Light


@dataclass(frozen=True, eq=False)
class Lamps:
    """lights: those of the scene; rows: a buffer of layout LIGHT, in their order; centre_ws as in `Placing`."""

    scope: GpuScope
    lights: tuple[Light, ...]
    rows: Buffer
    centre_ws: np.ndarray


def upload_lamps(device: Device, lights: tuple[Light, ...], centre: np.ndarray) -> Lamps:
    """Copy all lamps, positions relative to `centre`."""
    scope = device.scope()
    return Lamps(scope, lights, scope.buffer("lights", light_rows(lights, centre)), centre)


def light_rows(lights: Sequence[Light], centre: np.ndarray) -> np.ndarray:
    """Lamps in layout LIGHT, positions relative to `centre`, (3,) f8, metres."""
    rows = np.zeros(len(lights), layouts.dtype(layouts.LIGHT))
    for row, light in zip(rows, lights, strict=True):
        m = light.world_from_light
        row["position"] = m[:3, 3] - centre
        row["axis_x"], row["axis_y"], row["axis_z"] = (m[:3, i] / np.linalg.norm(m[:3, i]) for i in range(3))
        row["kind"] = layouts.CONSTANTS[f"LIGHT_{light.kind}"]
        row["emitted"], row["casts_shadow"] = light.emitted, light.casts_shadow
        row["is_ellipse"], row["spread"], row["soft_falloff"] = light.is_ellipse, light.spread, light.soft_falloff
        row["spot_cos"], row["spot_blend"] = np.cos(light.spot_angle / 2), light.spot_blend
        if light.kind == "AREA":
            row["size"] = light.size[0] / 2, light.size[1] / 2
        elif light.kind == "SUN":
            row["size"] = np.tan(min(light.angle, 3.1) / 2), 0
        else:
            row["size"] = light.radius, 0
    return rows
