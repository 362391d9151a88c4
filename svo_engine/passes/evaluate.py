# SPDX-License-Identifier: GPL-3.0-or-later
"""Hits -> Points: what hits look like. Here materials end: what comes after knows albedos, lobes and emission alone.

Each program of shaders/evaluate is for the materials that name it; a program that no used material names is not run.
"""

from __future__ import annotations

from ..gpu.buffer import Buffer
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.program import Resources
from ..scene.layouts import CONSTANTS
from .parts import EYE, LIST_HEAD, Part, Parts
from .raster import BEYOND, Eye
from .tracer import Tracer
from .upload import GpuScene
from .upload.shading import view_uniforms
from .upload.trees import BUSY, evaluate_trees

MATTE = Pass("evaluate/matte.comp.glsl")
PRINCIPLED = Pass("evaluate/principled.comp.glsl")

MOST_PASSED = 8  # surfaces that let the eye's ray pass, as Cycles has it by default
ONCE = 0x7FFFFFFF  # an invocation for each slot, see bind/list.glsl


def evaluate(device: Device, gpu_scene: GpuScene, eye: Eye, parts: Parts, part: Part, may_pass: bool) -> None:
    """Fill in the points that the eye sees. may_pass: whether `see_through` comes next."""
    slots = all_slots(parts, part)
    common = {**gpu_scene.geometry, **parts.of(part, EYE), **slots}
    device.dispatch(MATTE, part.n, Materials=gpu_scene.materials["Materials"], **common)
    if gpu_scene.needs.principled:
        device.dispatch(PRINCIPLED, part.n, **gpu_scene.materials, **common, u_albedo=gpu_scene.table.table,
                        u_takes_all=False)
    of_trees = _of_trees(gpu_scene, eye, parts.of(part, EYE), slots, "RAY_CAMERA", 0)
    evaluate_trees(device, gpu_scene.trees.passes, part.n, {**of_trees, "u_may_pass": may_pass})


def restyle(device: Device, gpu_scene: GpuScene, eye: Eye, parts: Parts, part: Part) -> None:
    """Have the trees that ask for light as a colour go on with that of their points, which are lit by now."""
    if styles := gpu_scene.trees.styles:
        given = _of_trees(gpu_scene, eye, parts.of(part, EYE), all_slots(parts, part), "RAY_CAMERA", 0)
        evaluate_trees(device, styles, part.n, {**given, "u_gloss": parts.planes["gloss"]})


def see_through(device: Device, gpu_scene: GpuScene, eye: Eye, tracer: Tracer, parts: Parts, part: Part) -> None:
    """Where trees have let the eye's ray pass, fill in the points behind, and behind those."""
    if not gpu_scene.needs.passes:
        return
    points, n, slots = parts.of(part, EYE), part.n, all_slots(parts, part)
    rays = {**tracer.resources(), "u_sees_trees": True, "u_depth": eye.rays[2], **eye.pixels(part),
            "u_tiles": eye.tiles, "u_sample": 0, "u_n_samples": 0, "u_seed": 0}
    for depth in range(1, MOST_PASSED + 1):
        behind = parts.lists[depth % 2]
        behind.clear(LIST_HEAD)
        given = {**rays, **points, **slots, "Next": behind}
        device.dispatch(BEYOND, n, tracer.constants(), **given)
        n, slots = listed(device, behind, part.n)
        if not n:
            return
        device.dispatch(PRINCIPLED, n, **gpu_scene.geometry, **gpu_scene.materials, **points, **slots,
                        u_albedo=gpu_scene.table.table, u_takes_all=True)
        of_trees = _of_trees(gpu_scene, eye, points, slots, "RAY_CAMERA", depth)
        evaluate_trees(device, gpu_scene.trees.passes, n, {**of_trees, "u_may_pass": depth < MOST_PASSED})


def evaluate_met(device: Device, gpu_scene: GpuScene, eye: Eye, parts: Parts, part: Part, n: int,
                 slots: Resources) -> None:
    """Fill in the points that paths met, of which few are left: by one program for all materials.

    slots  the resources of bind/list.glsl for n invocations
    """
    device.dispatch(PRINCIPLED, n, **gpu_scene.geometry, **gpu_scene.materials, **parts.of(part, parts.met), **slots,
                    u_albedo=gpu_scene.table.table, u_takes_all=True)
    given = _of_trees(gpu_scene, eye, parts.of(part, parts.met), slots, "RAY_GLOSSY", 1)
    evaluate_trees(device, gpu_scene.trees.passes, n, given)


def _of_trees(gpu_scene: GpuScene, eye: Eye, points: Resources, slots: Resources, rays: str, depth: int) -> Resources:
    """What compiled trees are given."""
    return {**gpu_scene.of_trees, **view_uniforms(eye.view, gpu_scene.centre_ws), **points, **slots,
            "u_footprint": eye.footprint, "u_rays": CONSTANTS[rays], "u_depth": depth, "u_wants_mean": False,
            "u_may_pass": False}


def all_slots(parts: Parts, part: Part) -> Resources:
    """What bind/list.glsl reads for all slots of a part."""
    return {"List": parts.lists[0], "u_is_listed": False, "u_step": ONCE, "u_n_all": part.n}


def listed(device: Device, slots: Buffer, most: int) -> tuple[int, Resources]:
    """Invocations for the slots of a list, and what bind/list.glsl reads then."""
    n = min(most, BUSY)
    listed: Resources = {"List": slots, "u_is_listed": True, "u_n_all": 0}
    if device.profiler.is_software:
        return int.from_bytes(slots.read(4), "little"), {**listed, "u_step": ONCE}
    return n, {**listed, "u_step": n}
