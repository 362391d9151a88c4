# SPDX-License-Identifier: GPL-3.0-or-later
"""GpuScene -> Glow: what shines and is no lamp, as lights that can be drawn. It stays while lamps are edited."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...gpu.texels import Texels
from ...scene import layouts
from ...scene.types import World
from ..upload.emission import Emission
from ..upload.placing import Placing
from ..upload.sky import Sky
from .emitters import emitters_of
from .sky import sky_table
from .tree import leaf_of_light, light_tree

EMITTER_DRAWS = 2


@dataclass(frozen=True, eq=False)
class Glow:
    """Emissive triangles and the world's image.

    triangles       texels of layout EMITTER; nodes: of their tree, which has n_leaves
    table           texels of what `sky_table` gives, of sky_size (columns, rows)
    world_from_env  (3, 3) f8
    """

    scope: GpuScope
    triangles: Texels
    nodes: Texels
    n_leaves: int
    n_emitters: int
    table: Texels
    sky_size: tuple[int, int]
    world_from_env: np.ndarray

    def draws(self) -> dict[str, int]:
        """Their part of the uniforms of bind/draws.glsl."""
        return {"u_n_emitter_draws": EMITTER_DRAWS * (self.n_emitters > 0), "u_n_sky_draws": int(self.sky_size[0] > 0)}

    def emitters(self) -> Resources:
        """What bind/emitters.glsl reads beside the numbers of draws."""
        return {"u_emitters": self.triangles, "u_n_emitters": self.n_emitters, "u_light_nodes": self.nodes,
                "u_emitter_tree": (0, self.n_leaves)}

    def sky(self) -> Resources:
        """What bind/sky.glsl reads beside the image."""
        return {"u_sky": self.table, "u_sky_size": self.sky_size, "u_world_from_env": self.world_from_env}


@dataclass(frozen=True, eq=False)
class SkyTable:
    """As `Glow` has them."""

    scope: GpuScope
    texels: Texels
    size: tuple[int, int]
    world_from_env: np.ndarray


def make_sky_table(device: Device, sky: Sky, world: World) -> SkyTable:
    """The world's image as a table of probabilities."""
    scope, table = device.scope(), sky_table(sky.image, world)
    return SkyTable(scope, scope.texels("sky table", _whole_texels(table)),
                    (0, 0) if table is None else (table.shape[1] - 1, table.shape[0]),
                    np.eye(3) if table is None else np.linalg.inv(world.env_from_world))


def make_glow(device: Device, placing: Placing, emission: Emission, sky: SkyTable) -> Glow:
    """What glows, on the device. GpuError names the buffer that does not fit."""
    scope, emitters = device.scope(), emitters_of(placing, emission)
    tree = light_tree(emitters.low, emitters.high, emitters.intensity)
    rows = np.zeros(len(emitters.work), layouts.dtype(layouts.EMITTER))
    rows["work"], rows["instance"], rows["triangle"] = emitters.work, emitters.instance, emitters.triangle
    rows["leaf"] = leaf_of_light(tree)
    return Glow(scope, scope.texels("emitters", rows), scope.texels("emitter tree", tree), len(tree) // 2, len(rows),
                sky.texels, sky.size, sky.world_from_env)


def _whole_texels(table: np.ndarray | None) -> np.ndarray:
    """The table in a row, filled up to whole texels of four numbers."""
    flat = np.zeros(0, "f4") if table is None else table.ravel()
    return np.concatenate([flat, np.zeros(-len(flat) % 4 or 4 * (not len(flat)), "f4")])
