# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps on the device."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ...gpu.buffer import Buffer
from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...gpu.texels import Texels
from ...scene import layouts
from ...scene.types import Light

# By the identity of a lamp: the first texel of its table, and its columns + 65536 rows
Places = Mapping[int, tuple[int, int]]


@dataclass(frozen=True, eq=False)
class Lamps:
    """lights: those of the scene; rows: a buffer of layout LIGHT, in their order; centre_ws as in `Placing`.

    tables  what their nodes make of their light, as bind/lamp_tables.glsl reads it; places: where
    """

    scope: GpuScope
    lights: tuple[Light, ...]
    rows: Buffer
    centre_ws: np.ndarray
    tables: Texels
    places: Places = field(default_factory=dict)

    def nodes(self) -> Resources:
        """What bind/lamp_tables.glsl reads."""
        bent = any(light.falloff != "QUADRATIC" or light.smoothing > 0 for light in self.lights)
        return {"u_lamp_tables": self.tables, "u_lamps_have_nodes": bent or bool(self.places)}


def upload_lamps(device: Device, lights: tuple[Light, ...], centre: np.ndarray,
                 tables: Sequence[np.ndarray | None] = ()) -> Lamps:
    """Copy all lamps, positions relative to `centre`.

    tables  for each lamp a factor of its light (height, width, 3) f4, or None
    """
    scope, texels, places, n = device.scope(), [np.zeros((1, 4), "f4")], dict[int, tuple[int, int]](), 1
    for light, table in zip(lights, tables, strict=False):
        if table is not None:
            places[id(light)] = n, table.shape[1] | table.shape[0] << 16
            texels.append(np.pad(table.reshape(-1, 3), ((0, 0), (0, 1))).astype("f4"))
            n += len(texels[-1])
    return Lamps(scope, lights, scope.buffer("lights", light_rows(lights, centre, places)), centre,
                 scope.texels("lamp tables", np.concatenate(texels)), places)


def light_rows(lights: Sequence[Light], centre: np.ndarray, places: Places | None = None) -> np.ndarray:
    """Lamps in layout LIGHT, positions relative to `centre`, (3,) f8, metres."""
    rows = np.zeros(len(lights), layouts.dtype(layouts.LIGHT))
    for row, light in zip(rows, lights, strict=True):
        m = light.world_from_light
        row["position"] = m[:3, 3] - centre
        row["axis_x"], row["axis_y"], row["axis_z"] = (m[:3, i] / np.linalg.norm(m[:3, i]) for i in range(3))
        row["kind"] = layouts.CONSTANTS[f"LIGHT_{light.kind}"]
        row["emitted"], row["casts_shadow"] = light.emitted, light.casts_shadow
        row["is_ellipse"], row["spread"], row["soft_falloff"] = light.is_ellipse, light.spread, light.soft_falloff
        row["falloff"], row["smoothing"] = layouts.CONSTANTS[f"FALLOFF_{light.falloff}"], light.smoothing
        row["table"], row["table_size"] = (places or {}).get(id(light), (0, 0))
        row["spot_cos"], row["spot_blend"] = np.cos(light.spot_angle / 2), light.spot_blend
        if light.kind == "AREA":
            row["size"] = light.size[0] / 2, light.size[1] / 2
        elif light.kind == "SUN":
            row["size"] = np.tan(min(light.angle, 3.1) / 2), 0
        else:
            row["size"] = light.radius, 0
    return rows
