# SPDX-License-Identifier: GPL-3.0-or-later
"""Points -> gloss: what mirrors and glass show, along paths that grow by a vertex a round.

A round is two dispatches: `evaluate` makes points of what paths met, `path/step` lights them and traces the next leg of
those that go on. Only the device knows how many that are: a round is for as many invocations as keep it busy, which
take the paths in turns. So the host never waits; where the processor renders it asks, for nothing.
"""

from __future__ import annotations

from ..gpu.buffer import Buffer
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.program import Resources
from .cache import LightCache
from .evaluate import all_slots, evaluate_met, listed
from .lights import Lights
from .parts import EYE, LIST_HEAD, Part, Parts
from .raster import Eye
from .tracer import Tracer
from .upload import GpuScene

DRAW = Pass("lights/draw.comp.glsl")
STEP = Pass("path/step.comp.glsl")
WEIGH = Pass("lights/weigh.comp.glsl")


def follow_paths(device: Device, gpu_scene: GpuScene, cache: LightCache, tracer: Tracer, lights: Lights, eye: Eye,
                 parts: Parts, part: Part) -> None:
    """Follow a path from each point that the eye sees, until none is left or all are as long as a path can be."""
    most, has_emitters = gpu_scene.needs.path_vertices - 1, lights.has_emitters(gpu_scene.needs)
    common = {**tracer.resources(), **lights.resources(), **gpu_scene.world(), **cache.resources(),
              "u_paths": parts.planes["paths"], "u_met": parts.met, "u_gloss": parts.planes["gloss"]}

    def step(points: int, n: int, slots: Resources, n_legs: int) -> Buffer:
        """Light points and go on from them; gives the list of paths that do."""
        following = parts.lists[(n_legs + 1) % 2]
        following.clear(LIST_HEAD)
        device.dispatch(STEP, n, tracer.constants(), **common, **parts.of(part, points), **slots, Next=following,
                        u_round=n_legs, u_is_last=n_legs == most)
        return following

    going, points = step(EYE, part.n, all_slots(parts, part), 0), EYE
    with device.batch("path/rounds"):
        for n_legs in range(1, most + 1):
            n, slots = listed(device, going, part.n)
            if not n:
                return
            if has_emitters:
                device.dispatch(WEIGH, n, **gpu_scene.geometry, **lights.emitters(), **parts.of(part, points), **slots,
                                u_met=parts.met)
            points = parts.met
            evaluate_met(device, gpu_scene, eye, parts, part, n, slots)
            if has_emitters and n_legs < most:
                device.dispatch(DRAW, n, **gpu_scene.geometry, **gpu_scene.emission.read, **lights.emitters(),
                                **parts.of(part, points), **slots, u_seed_offset=3)
            going = step(points, n, slots, n_legs)
            device.profiler.counts["path rounds"] += 1
