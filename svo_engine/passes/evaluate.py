# SPDX-License-Identifier: GPL-3.0-or-later
"""Hits -> Points: what hits look like. Here materials end: what comes after knows albedos, lobes and emission alone.

Each program of shaders/evaluate is for the materials that name it; a program that no used material names is not run.
"""

from __future__ import annotations

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.program import Resources
from ..scene.layouts import CONSTANTS
from .parts import EYE, Part, Parts
from .raster import Eye
from .upload import GpuScene
from .upload.shading import view_uniforms
from .upload.trees import evaluate_trees

MATTE = Pass("evaluate/matte.comp.glsl")
PRINCIPLED = Pass("evaluate/principled.comp.glsl")

ONCE = 0x7FFFFFFF  # an invocation for each slot, see bind/list.glsl


def evaluate(device: Device, gpu_scene: GpuScene, eye: Eye, parts: Parts, part: Part) -> None:
    """Fill in the points that the eye sees."""
    slots = all_slots(parts, part)
    common = {**gpu_scene.geometry, **parts.of(part, EYE), **slots}
    device.dispatch(MATTE, part.n, Materials=gpu_scene.materials["Materials"], **common)
    if gpu_scene.needs.principled:
        device.dispatch(PRINCIPLED, part.n, **gpu_scene.materials, **common, u_albedo=gpu_scene.table.table,
                        u_takes_all=False)
    given = _of_trees(gpu_scene, eye, parts.of(part, EYE), slots, "RAY_CAMERA", 0)
    evaluate_trees(device, gpu_scene.trees, part.n, given)


def evaluate_met(device: Device, gpu_scene: GpuScene, eye: Eye, parts: Parts, part: Part, n: int,
                 slots: Resources) -> None:
    """Fill in the points that paths met, of which few are left: by one program for all materials.

    slots  the resources of bind/list.glsl for n invocations
    """
    device.dispatch(PRINCIPLED, n, **gpu_scene.geometry, **gpu_scene.materials, **parts.of(part, parts.met), **slots,
                    u_albedo=gpu_scene.table.table, u_takes_all=True)
    given = _of_trees(gpu_scene, eye, parts.of(part, parts.met), slots, "RAY_GLOSSY", 1)
    evaluate_trees(device, gpu_scene.trees, n, given)


def _of_trees(gpu_scene: GpuScene, eye: Eye, points: Resources, slots: Resources, rays: str, depth: int) -> Resources:
    """What compiled trees are given."""
    return {**gpu_scene.of_trees, **view_uniforms(eye.view, gpu_scene.centre_ws), **points, **slots,
            "u_footprint": eye.footprint, "u_rays": CONSTANTS[rays], "u_depth": depth, "u_wants_mean": False}


def all_slots(parts: Parts, part: Part) -> Resources:
    """What bind/list.glsl reads for all slots of a part."""
    return {"List": parts.lists[0], "u_is_listed": False, "u_step": ONCE, "u_n_all": part.n}
