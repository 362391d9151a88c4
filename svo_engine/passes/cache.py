# SPDX-License-Identifier: GPL-3.0-or-later
"""Octree -> Links -> LightCache: what each side of each surfel sees, then what it reflects: light and all bounces."""

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
SIDES = ("Octree", "Surfels")
CACHE = (*SIDES, "Cache")
CACHE_UNIFORMS = (*GRID, *TREE, "u_n_sides")
PARTS = 5  # vec4 a side, see bind/cache.glsl

LINK = Pass(("cache/link.comp.glsl",), (*GEOMETRY, *MATERIALS, *SIDES, *LIGHTS, "Links", "Found"),
            textures=("u_env", *TRACE, *LIGHT_TEXTURES),
            uniforms=(*CACHE_UNIFORMS, *TRACE_UNIFORMS, *WORLD, *LIGHT_UNIFORMS, "u_first_ray", "u_end_ray"))
DIRECT = Pass(("cache/direct.comp.glsl",), (*GEOMETRY, *MATERIALS, *CACHE, *LIGHTS, "Found"),
              textures=("u_env", *TRACE, *LIGHT_TEXTURES),
              uniforms=(*CACHE_UNIFORMS, *TRACE_UNIFORMS, *WORLD, *LIGHT_UNIFORMS))
BOUNCE = Pass(("cache/bounce.comp.glsl",), (*CACHE, "Links", "Changes"),
              uniforms=(*CACHE_UNIFORMS, "u_sweep", "u_tolerance"))

TOLERANCE = 5e-3  # of the brightest radiance: bounces end when none changes more
SPLIT = 4  # invocations that share the rays of a side
ROUND = 256  # rays of a side at once: Mesa's software renderer ends an invocation's loops after 65,535 turns in all
BATCH = 16  # sweeps between two looks at whether any more are needed: those that are not end at once


@dataclass(frozen=True, eq=False)
class Links:
    """What the n_rays rays of every side hit. They stay while lamps are edited.

    found   the light that they saw, weighed against n_points times all draws
    """

    scope: GpuScope
    octree: Octree
    links: Any
    found: Any
    n_rays: int
    n_points: int


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
        return {**_octree(self.octree), "Cache": self.entries}

    def n_bounces(self) -> int:
        """Bounces that were done until nothing changed any more; waits for the device."""
        return _n_done(self.changes, self.max_bounces)


def link(device: Device, gpu_scene: GpuScene, octree: Octree, bvh: Bvh, lights: Lights, n_rays: int,
         n_points: int) -> Links:
    """Trace the rays of all sides. Of `lights` the lamps do not matter."""
    scope, n_sides = device.scope(), 2 * octree.n_surfels
    links = scope.buffer("cache links", 4 * n_rays * n_sides)
    found = scope.buffer("found light", 16 * n_sides)
    constants = {**_constants(gpu_scene, n_rays, n_points), **bvh.constants(), **lights.glow.constants(),
                 "HAS_EMISSION": gpu_scene.emission_unit > 0, "SPLIT": SPLIT}
    for first in range(0, n_rays, ROUND):
        device.dispatch(LINK, SPLIT * n_sides, constants, **_resources(gpu_scene, octree, bvh, lights), Links=links,
                        Found=found, u_first_ray=first, u_end_ray=min(first + ROUND, n_rays))
    return Links(scope, octree, links, found, n_rays, n_points)


def light_cache(device: Device, gpu_scene: GpuScene, links: Links, bvh: Bvh, lights: Lights,
                max_bounces: int) -> LightCache:
    """Light the surfels: what is drawn, then bounces until the change is below TOLERANCE or `max_bounces` were done."""
    scope, octree, n_sides = device.scope(), links.octree, 2 * links.octree.n_surfels
    entries = scope.buffer("light cache", 16 * PARTS * n_sides)
    changes = scope.buffer("changes", 4 * max_bounces, clear=True)
    constants = {**_constants(gpu_scene, links.n_rays, links.n_points), **bvh.constants(), **lights.constants()}
    device.dispatch(DIRECT, n_sides, constants, **_resources(gpu_scene, octree, bvh, lights), Cache=entries,
                    Found=links.found)
    for sweep in range(max_bounces):
        if sweep and sweep % BATCH == 0 and _n_done(changes, sweep) < sweep:
            break
        device.dispatch(BOUNCE, n_sides, {"N_RAYS": links.n_rays}, **_octree(octree), Cache=entries, Links=links.links,
                        Changes=changes, u_sweep=sweep, u_tolerance=TOLERANCE)
    return LightCache(scope, octree, entries, changes, max_bounces)


def _n_done(buffer: Any, n: int) -> int:
    """Of n sweeps those that were done, as bounce.comp.glsl ends them: until one changed little, or all."""
    changes = np.frombuffer(buffer.read(4 * n) if n else b"", "f4")
    is_small = changes <= np.float32(TOLERANCE) * np.maximum.accumulate(changes)
    return int(np.argmax(is_small)) + 1 if is_small.any() else n


def _constants(gpu_scene: GpuScene, n_rays: int, n_points: int) -> dict[str, bool | int]:
    return {"HAS_ALPHA": gpu_scene.has_alpha, "HAS_TEXTURES": gpu_scene.has_textures, "N_RAYS": n_rays,
            "N_POINTS": n_points}


def _octree(octree: Octree) -> dict[str, Any]:
    return {**octree.resources(), "Surfels": octree.surfels, "u_n_sides": 2 * octree.n_surfels}


def _resources(gpu_scene: GpuScene, octree: Octree, bvh: Bvh, lights: Lights) -> dict[str, Any]:
    """What a pass needs that lights the sides."""
    return {**gpu_scene.geometry, **gpu_scene.materials, **gpu_scene.world(), **_octree(octree), **bvh.resources(),
            **lights.resources()}
