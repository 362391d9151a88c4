# SPDX-License-Identifier: GPL-3.0-or-later
"""Octree -> LightCache: what each side of each surfel reflects, the lights' light and all bounces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from .bvh import TRACE, TRACE_UNIFORMS, Bvh
from .lights import LIGHT_TEXTURES, LIGHT_UNIFORMS, LIGHTS, Lights
from .octree import TREE, Octree
from .upload import GpuScene
from .voxelize import GEOMETRY, GRID, MATERIALS

WORLD = ("u_world_radiance", "u_env_from_world", "u_has_env")
CACHE = ("Octree", "Surfels", "Cache")
CACHE_UNIFORMS = (*GRID, *TREE, "u_n_sides")
PARTS = 5  # vec4 a side, see bind/cache.glsl

LINK = Pass(("cache/link.comp.glsl",), (*GEOMETRY, *MATERIALS, *CACHE, *LIGHTS, "Links"),
            textures=("u_env", *TRACE, *LIGHT_TEXTURES),
            uniforms=(*CACHE_UNIFORMS, *TRACE_UNIFORMS, *WORLD, *LIGHT_UNIFORMS, "u_first_ray", "u_end_ray"))
DIRECT = Pass(("cache/direct.comp.glsl",), (*GEOMETRY, *MATERIALS, *CACHE, *LIGHTS),
              textures=("u_env", *TRACE, *LIGHT_TEXTURES),
              uniforms=(*CACHE_UNIFORMS, *TRACE_UNIFORMS, *WORLD, *LIGHT_UNIFORMS))
BOUNCE = Pass(("cache/bounce.comp.glsl",), (*CACHE, "Links", "Changes"),
              uniforms=(*CACHE_UNIFORMS, "u_sweep", "u_tolerance"))

TOLERANCE = 5e-3  # of the brightest radiance: bounces end when none changes more
SPLIT = 4  # invocations that share the rays of a side
ROUND = 256  # rays of a side at once: Mesa's software renderer ends an invocation's loops after 65,535 turns in all
BATCH = 16  # sweeps between two looks at whether any more are needed: those that are not end at once


@dataclass(frozen=True, eq=False)
class LightCache:
    """entries: the buffer of bind/cache.glsl. changes: largest change of radiance in each of max_bounces sweeps, f4."""

    scope: GpuScope
    octree: Octree
    entries: Any
    changes: Any
    max_bounces: int

    def resources(self) -> dict[str, Any]:
        """What a pass that includes bind/cache.glsl needs."""
        return _resources(self.octree, self.entries)

    def n_bounces(self) -> int:
        """Bounces that were done until nothing changed any more; waits for the device."""
        return _n_done(self.changes, self.max_bounces)


def light_cache(device: Device, gpu_scene: GpuScene, octree: Octree, bvh: Bvh, lights: Lights, n_rays: int,
                n_points: int, max_bounces: int) -> LightCache:
    """Light the surfels: what is drawn, then bounces until the change is below TOLERANCE or `max_bounces` were done."""
    scope, n_sides = device.scope(), 2 * octree.n_surfels
    entries = scope.buffer("light cache", 16 * PARTS * n_sides)
    changes = scope.buffer("changes", 4 * max_bounces, clear=True)
    constants = {"HAS_ALPHA": gpu_scene.has_alpha, "HAS_TEXTURES": gpu_scene.has_textures, "N_RAYS": n_rays,
                 "N_POINTS": n_points, **bvh.constants(), **lights.constants()}
    cache = _resources(octree, entries)
    resources = {**gpu_scene.geometry, **gpu_scene.materials, **gpu_scene.world(), **bvh.resources(), **cache,
                 **lights.resources()}
    with device.scope() as scratch:
        links = scratch.buffer("cache links", 4 * n_rays * n_sides)
        has_emission = {"HAS_EMISSION": gpu_scene.emission_unit > 0}
        for first in range(0, n_rays, ROUND):
            device.dispatch(LINK, SPLIT * n_sides, {**constants, **has_emission, "SPLIT": SPLIT}, **resources,
                            Links=links, u_first_ray=first, u_end_ray=min(first + ROUND, n_rays))
        device.dispatch(DIRECT, n_sides, constants, **resources)
        for sweep in range(max_bounces):
            if sweep and sweep % BATCH == 0 and _n_done(changes, sweep) < sweep:
                break
            device.dispatch(BOUNCE, n_sides, {"N_RAYS": n_rays}, **cache, Links=links, Changes=changes, u_sweep=sweep,
                            u_tolerance=TOLERANCE)
    return LightCache(scope, octree, entries, changes, max_bounces)


def _n_done(buffer: Any, n: int) -> int:
    """Of n sweeps those that were done, as bounce.comp.glsl ends them: until one changed little, or all."""
    changes = np.frombuffer(buffer.read(4 * n) if n else b"", "f4")
    is_small = changes <= np.float32(TOLERANCE) * np.maximum.accumulate(changes)
    return int(np.argmax(is_small)) + 1 if is_small.any() else n


def _resources(octree: Octree, entries: Any) -> dict[str, Any]:
    return {**octree.resources(), "Surfels": octree.surfels, "Cache": entries, "u_n_sides": 2 * octree.n_surfels}
