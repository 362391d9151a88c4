# SPDX-License-Identifier: GPL-3.0-or-later
"""GpuScene -> Glow: what shines and is no lamp, as lights that can be drawn. It stays while lamps are edited."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...gpu.device import Device
from ...gpu.scope import GpuScope
from ...scene import layouts
from ..upload import GpuScene
from .emitters import emitters_of
from .sky import sky_table
from .tree import leaf_of_light, light_tree

EMITTER_DRAWS = 2


@dataclass(frozen=True, eq=False)
class Glow:
    """Emissive triangles and the world's image. tree: LIGHT_NODE rows; bound: what the shaders read, by name."""

    scope: GpuScope
    tree: np.ndarray
    bound: dict[str, Any]
    n_emitters: int
    has_sky: bool

    @property
    def n_draws(self) -> int:
        """Draws of each pixel and sample."""
        return EMITTER_DRAWS * (self.n_emitters > 0) + self.has_sky

    def constants(self) -> dict[str, bool | int | float]:
        """What is not there is not compiled."""
        return {"HAS_EMITTERS": self.n_emitters > 0, "HAS_WORLD_DRAWS": self.has_sky, "N_EMITTER_DRAWS": EMITTER_DRAWS}


def make_glow(device: Device, gpu_scene: GpuScene) -> Glow:
    """What glows in `gpu_scene`, on the device. GpuError names the buffer that does not fit."""
    scope, emitters, sky = device.scope(), emitters_of(gpu_scene), sky_table(gpu_scene.scene)
    tree = light_tree(emitters.low, emitters.high, emitters.intensity)
    rows = np.zeros(len(emitters.work), layouts.dtype(layouts.EMITTER))
    rows["work"], rows["instance"], rows["triangle"] = emitters.work, emitters.instance, emitters.triangle
    rows["leaf"] = leaf_of_light(tree)
    bound = {
        "u_emitters": scope.texels("emitters", rows), "u_n_emitters": len(rows),
        "u_sky": scope.texels("sky table", _whole_texels(sky)),
        "u_sky_size": (0, 0) if sky is None else (sky.shape[1] - 1, sky.shape[0]),
        "u_world_from_env": np.eye(3) if sky is None else np.linalg.inv(gpu_scene.scene.world.env_from_world)}
    return Glow(scope, tree, bound, len(rows), sky is not None)


def _whole_texels(table: np.ndarray | None) -> np.ndarray:
    """The table in a row, filled up to whole texels of four numbers."""
    flat = np.zeros(0, "f4") if table is None else table.ravel()
    return np.concatenate([flat, np.zeros(-len(flat) % 4 or 4 * (not len(flat)), "f4")])
