# SPDX-License-Identifier: GPL-3.0-or-later
"""Octree -> Links -> LightCache: what each side of each surfel sees, then what it reflects: light and all bounces.

Each part depends on less than all, so that an edit redoes little: links on what stops rays, Found on what shines and is
no lamp, Drawn on lamps too; colours of surfels count for bounces alone, which trace nothing.
"""

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
from .octree import Colors, Octree
from .tracer import Tracer
from .upload.emission import Emission
from .upload.placing import Placing
from .upload.sky import Sky, world_uniforms

PARTS = 6  # vec4 a side, see bind/cache.glsl

LINK = Pass("cache/link.comp.glsl")
SKY = Pass("cache/sky.comp.glsl")
FOUND = Pass("cache/found.comp.glsl")
DRAW = Pass("cache/draw.comp.glsl")
DIRECT = Pass("cache/direct.comp.glsl")
START = Pass("cache/start.comp.glsl")
BOUNCE = Pass("cache/bounce.comp.glsl")
FINISH = Pass("cache/finish.comp.glsl")

TOLERANCE = 5e-3  # of the brightest radiance: bounces end when none changes more
SPLIT = 4  # invocations that share the rays of a side
ROUND = 256  # rays of a side at once: Mesa's software renderer ends an invocation's loops after 65,535 turns in all
BATCH = 16  # sweeps between two looks at whether any more are needed: those that are not end at once
HITS = 1 << 26  # bytes of what links hit that are kept although nothing shines, for when something will


@dataclass(frozen=True, eq=False)
class Links:
    """What the n_rays rays of every side hit. hits: triangles and where on them, or None where nobody will ask."""

    scope: GpuScope
    octree: Octree
    links: Buffer
    hits: Buffer | None
    n_rays: int


@dataclass(frozen=True, eq=False)
class Found:
    """light: vec4 a side, irradiance [W m^-2] that its links saw, weighed against n_points times all draws."""

    scope: GpuScope
    light: Buffer
    n_points: int


@dataclass(frozen=True, eq=False)
class Drawn:
    """light: vec4 a side, irradiance [W m^-2] of lamps, and as many of what shines besides and was drawn."""

    scope: GpuScope
    light: Buffer


@dataclass(frozen=True, eq=False)
class LightCache:
    """entries: the buffer of bind/cache.glsl. changes: largest change of radiance in each of max_bounces sweeps, f4."""

    scope: GpuScope
    octree: Octree
    colors: Colors
    entries: Buffer
    changes: Buffer
    max_bounces: int

    def resources(self) -> Resources:
        """What a pass that includes bind/cache.glsl needs."""
        return {**_octree(self.octree), "Cache": self.entries}

    def n_bounces(self) -> int:
        """Bounces that were done until nothing changed any more; waits for the device."""
        return _n_done(self.changes, self.max_bounces)


def keeps_hits(octree: Octree, n_rays: int, shines: bool) -> bool:
    """Whether links are to keep what they hit. Also if nothing shines, so that the first thing that does traces none
    anew, unless that takes too much memory.
    """
    return shines or 32 * n_rays * octree.n_surfels <= HITS


def link(device: Device, placing: Placing, octree: Octree, tracer: Tracer, n_rays: int, has_hits: bool) -> Links:
    """Trace the rays of all sides."""
    scope, n_sides = device.scope(), 2 * octree.n_surfels
    links = scope.buffer("cache links", 4 * n_rays * n_sides)
    hits = scope.buffer("what links hit", 16 * n_rays * n_sides) if has_hits else None
    for first in range(0, n_rays, ROUND):
        device.dispatch(LINK, SPLIT * n_sides, tracer.constants(), **tracer.resources(), **_octree(octree), Cache=None,
                        Positions=placing.geometry["Positions"], Links=links, LinkHits=hits,
                        u_first_ray=first, u_end_ray=min(first + ROUND, n_rays), u_keeps_hits=has_hits)
    return Links(scope, octree, links, hits, n_rays)


def find_light(device: Device, placing: Placing, emission: Emission, links: Links, glow: Glow, sky: Sky, world: World,
               has_world: bool, n_points: int) -> Found:
    """The light of the world and of emissive triangles along the links."""
    octree = links.octree
    scope, n_sides, shines = device.scope(), 2 * octree.n_surfels, emission.highest > 0
    light = scope.buffer("found light", 16 * n_sides, clear=not has_world)
    draws = {"u_n_lamps": 0, "u_n_tree_draws": 0, **glow.draws()}
    common = {**_octree(octree), **draws, "Cache": None, "Found": light, "u_n_rays": links.n_rays,
              "u_n_points": n_points}
    if has_world:
        device.dispatch(SKY, n_sides, **glow.sky(), **world_uniforms(sky, world), **common, Links=links.links)
    if shines:
        device.dispatch(FOUND, n_sides, **placing.geometry, **emission.read, **glow.emitters(), **common,
                        LinkHits=links.hits)
    return Found(scope, light, n_points)


def draw_light(device: Device, placing: Placing, emission: Emission, octree: Octree, tracer: Tracer, lights: Lights,
               sky: Sky, world: World, n_rays: int, n_points: int) -> Drawn:
    """n_points times all draws of light at every side, with traced shadows, weighed against its n_rays rays."""
    scope, n_sides, n_all = device.scope(), 2 * octree.n_surfels, lights.n_draws
    drawn = scope.buffer("drawn light", 32 * n_sides, clear=not n_all)
    n_draws = n_points * lights.glow.draws()["u_n_emitter_draws"]
    n_part = _sides_at_once(device, n_draws)
    with device.scope() as scratch:
        draws = scratch.buffer("draws of sides", 32 * n_draws * min(n_part, n_sides))
        for start in range(0, n_sides if n_all else 0, n_part):
            n = min(n_part, n_sides - start)
            common = {**_octree(octree), "Cache": None, "Draws": draws, "u_start": start, "u_stride": n,
                      "u_n_points": n_points}
            if n_draws:
                device.dispatch(DRAW, n, **placing.geometry, **emission.read, **lights.emitters(), **common)
            device.dispatch(DIRECT, n, tracer.constants(), **tracer.resources(), **lights.resources(),
                            **world_uniforms(sky, world), **common, Drawn=drawn, u_n_rays=n_rays)
    return Drawn(scope, drawn)


def light_cache(device: Device, colors: Colors, links: Links, found: Found, drawn: Drawn,
                max_bounces: int) -> LightCache:
    """Bounces, until the change is below TOLERANCE or `max_bounces` were done."""
    scope, octree, n_sides = device.scope(), links.octree, 2 * links.octree.n_surfels
    entries = scope.buffer("light cache", 16 * PARTS * n_sides)
    changes = scope.buffer("changes", 4 * max_bounces, clear=True)
    common = {**_octree(octree), **colors.resources(), "Cache": entries}
    device.dispatch(START, n_sides, **common, Drawn=drawn.light, Found=found.light)
    for sweep in range(max_bounces):
        if sweep and sweep % BATCH == 0 and _n_done(changes, sweep) < sweep:
            break
        device.dispatch(BOUNCE, n_sides, **common, Links=links.links, Changes=changes, u_n_rays=links.n_rays,
                        u_sweep=sweep, u_tolerance=TOLERANCE)
    device.dispatch(FINISH, n_sides, **common)
    return LightCache(scope, octree, colors, entries, changes, max_bounces)


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
