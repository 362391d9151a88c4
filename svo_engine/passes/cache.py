# SPDX-License-Identifier: GPL-3.0-or-later
"""Octree -> Links -> LightCache: what each side of each surfel sees, then what it reflects: light and all bounces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..gpu.buffer import Buffer
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.program import Resources
from ..gpu.scope import GpuScope
from ..scene.types import World
from .lights import Lights
from .lights.glow import Glow
from .octree import Octree
from .tracer import Tracer
from .upload.looks import Looks
from .upload.placing import Placing
from .upload.sky import Sky, world_uniforms

PARTS = 5  # vec4 a side, see bind/cache.glsl

LINK = Pass("cache/link.comp.glsl")
FOUND = Pass("cache/found.comp.glsl")
DRAW = Pass("cache/draw.comp.glsl")
DIRECT = Pass("cache/direct.comp.glsl")
BOUNCE = Pass("cache/bounce.comp.glsl")

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
    links: Buffer
    found: Buffer
    n_rays: int
    n_points: int


@dataclass(frozen=True, eq=False)
class LightCache:
    """entries: the buffer of bind/cache.glsl. changes: largest change of radiance in each of max_bounces sweeps, f4."""

    scope: GpuScope
    octree: Octree
    entries: Buffer
    changes: Buffer
    max_bounces: int

    def resources(self) -> Resources:
        """What a pass that includes bind/cache.glsl needs."""
        return {**_octree(self.octree), "Cache": self.entries}

    def n_bounces(self) -> int:
        """Bounces that were done until nothing changed any more; waits for the device."""
        return _n_done(self.changes, self.max_bounces)


def link(device: Device, placing: Placing, looks: Looks, octree: Octree, tracer: Tracer, glow: Glow, sky: Sky,
         world: World, n_rays: int, n_points: int) -> Links:
    """Trace the rays of all sides."""
    scope, n_sides, shines = device.scope(), 2 * octree.n_surfels, looks.emission_unit > 0
    links = scope.buffer("cache links", 4 * n_rays * n_sides)
    found = scope.buffer("found light", 16 * n_sides)
    draws = {"u_n_lamps": 0, "u_n_tree_draws": 0, **glow.draws()}
    common = {**_octree(octree), **draws, "Cache": None, "Found": found, "u_n_rays": n_rays, "u_n_points": n_points}
    with device.scope() as scratch:
        hits = scratch.buffer("what links hit", 16 * n_rays * n_sides * shines)
        for first in range(0, n_rays, ROUND):
            device.dispatch(LINK, SPLIT * n_sides, tracer.constants(), **tracer.resources(), **glow.sky(),
                            **world_uniforms(sky, world), **common, Positions=placing.geometry["Positions"],
                            Links=links, LinkHits=hits, u_first_ray=first, u_end_ray=min(first + ROUND, n_rays),
                            u_keeps_hits=shines)
        if shines:
            device.dispatch(FOUND, n_sides, **placing.geometry, **looks.materials, **glow.emitters(), **common,
                            LinkHits=hits)
    return Links(scope, octree, links, found, n_rays, n_points)


def light_cache(device: Device, placing: Placing, looks: Looks, links: Links, tracer: Tracer, lights: Lights,
                sky: Sky, world: World, max_bounces: int) -> LightCache:
    """Light the surfels: what is drawn, then bounces until the change is below TOLERANCE or `max_bounces` were done."""
    scope, octree, n_sides = device.scope(), links.octree, 2 * links.octree.n_surfels
    entries = scope.buffer("light cache", 16 * PARTS * n_sides)
    changes = scope.buffer("changes", 4 * max_bounces, clear=True)
    n_draws = links.n_points * lights.glow.draws()["u_n_emitter_draws"]
    n_part = _sides_at_once(device, n_draws)
    with device.scope() as scratch:
        draws = scratch.buffer("draws of sides", 32 * n_draws * min(n_part, n_sides))
        for start in range(0, n_sides, n_part):
            n = min(n_part, n_sides - start)
            common = {**_octree(octree), "Cache": entries, "Draws": draws, "u_start": start, "u_stride": n,
                      "u_n_points": links.n_points}
            if n_draws:
                device.dispatch(DRAW, n, **placing.geometry, **looks.materials, **lights.emitters(), **common)
            device.dispatch(DIRECT, n, tracer.constants(), **tracer.resources(), **lights.resources(),
                            **world_uniforms(sky, world), **common, Found=links.found, u_n_rays=links.n_rays)
    for sweep in range(max_bounces):
        if sweep and sweep % BATCH == 0 and _n_done(changes, sweep) < sweep:
            break
        device.dispatch(BOUNCE, n_sides, **_octree(octree), Cache=entries, Links=links.links, Changes=changes,
                        u_n_rays=links.n_rays, u_sweep=sweep, u_tolerance=TOLERANCE)
    return LightCache(scope, octree, entries, changes, max_bounces)


def _sides_at_once(device: Device, n_draws: int) -> int:
    """Sides whose draws fit one buffer."""
    return max(int(device.limits["GL_MAX_SHADER_STORAGE_BLOCK_SIZE"]) // (32 * max(n_draws, 1)) // 64 * 64, 64)


def _n_done(buffer: Buffer, n: int) -> int:
    """Of n sweeps those that were done, as bounce.comp.glsl ends them: until one changed little, or all."""
    changes = np.frombuffer(buffer.read(4 * n) if n else b"", "f4")
    is_small = changes <= np.float32(TOLERANCE) * np.maximum.accumulate(changes)
    return int(np.argmax(is_small)) + 1 if is_small.any() else n


def _octree(octree: Octree) -> Resources:
    return {**octree.resources(), "Surfels": octree.surfels, "u_n_sides": 2 * octree.n_surfels}
