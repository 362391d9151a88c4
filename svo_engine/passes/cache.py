# SPDX-License-Identifier: GPL-3.0-or-later
"""Octree -> LightCache: what each side of each surfel sends out, the lamps' light and all bounces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from .bvh import TRACE, TRACE_UNIFORMS, Bvh
from .octree import TREE, Octree
from .upload import GpuScene
from .voxelize import GEOMETRY, GRID, MATERIALS

WORLD = ("u_world_radiance", "u_env_from_world", "u_has_env")
CACHE = ("Octree", "Surfels", "Cache")
CACHE_UNIFORMS = (*GRID, *TREE, "u_n_sides")
PARTS = 4  # vec4 a side, see bind/cache.glsl

DIRECT = Pass(("cache/direct.comp.glsl",), (*GEOMETRY, *MATERIALS, *CACHE, "Lights"), textures=TRACE,
              uniforms=(*CACHE_UNIFORMS, *TRACE_UNIFORMS))
BOUNCE = Pass(("cache/bounce.comp.glsl",), (*GEOMETRY, *MATERIALS, *CACHE, "Change"), textures=("u_env", *TRACE),
              uniforms=(*CACHE_UNIFORMS, *TRACE_UNIFORMS, *WORLD, "u_from"))

TOLERANCE = 5e-3  # of the brightest radiance: bounces end when none changes more


@dataclass(frozen=True, eq=False)
class LightCache:
    """entries: the buffer of bind/cache.glsl. n_bounces: those that were done until nothing changed any more."""

    scope: GpuScope
    octree: Octree
    entries: Any
    n_bounces: int

    def resources(self) -> dict[str, Any]:
        """What a pass that includes bind/cache.glsl needs."""
        return _resources(self.octree, self.entries)


def light_cache(device: Device, gpu_scene: GpuScene, octree: Octree, bvh: Bvh, n_rays: int, n_points: int,
                max_bounces: int) -> LightCache:
    """Light the surfels: lamps, then bounces until the change is below TOLERANCE or `max_bounces` were done."""
    scope, n_sides = device.scope(), 2 * octree.n_surfels
    entries = scope.buffer("light cache", 16 * PARTS * n_sides)
    constants = {"HAS_ALPHA": gpu_scene.has_alpha, **bvh.constants()}
    lamps = {"N_LIGHTS": len(gpu_scene.scene.lights), "N_POINTS": n_points}
    resources = {**gpu_scene.geometry, **gpu_scene.materials, **bvh.resources(), **_resources(octree, entries)}
    device.dispatch(DIRECT, n_sides, {**constants, **lamps}, **resources, Lights=gpu_scene.lights)
    change, brightest, largest, n_bounces = scope.buffer("change", 4), 0.0, 1.0, 0
    while n_bounces < max_bounces and largest > TOLERANCE * brightest:
        change.clear()
        device.dispatch(BOUNCE, n_sides, {"N_RAYS": n_rays, **constants}, **resources, **gpu_scene.world(),
                        Change=change, u_from=n_bounces % 2)
        largest = float(np.frombuffer(change.read(4), "f4")[0])
        brightest = max(brightest, largest)
        n_bounces += 1
    return LightCache(scope, octree, entries, n_bounces)


def _resources(octree: Octree, entries: Any) -> dict[str, Any]:
    return {**octree.resources(), "Surfels": octree.surfels, "Cache": entries, "u_n_sides": 2 * octree.n_surfels}
