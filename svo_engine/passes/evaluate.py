# SPDX-License-Identifier: GPL-3.0-or-later
"""Hits -> Points: what hits look like. Here materials end: what comes after knows albedos, lobes and emission alone.

Each program of shaders/evaluate is for the materials that name it; a program that no used material names is not run.
"""

from __future__ import annotations

from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.program import Resources
from .parts import EYE, Part, Parts
from .upload import GpuScene

MATTE = Pass("evaluate/matte.comp.glsl")
PRINCIPLED = Pass("evaluate/principled.comp.glsl")

ONCE = 0x7FFFFFFF  # an invocation for each slot, see bind/list.glsl


def evaluate(device: Device, gpu_scene: GpuScene, parts: Parts, part: Part) -> None:
    """Fill in the points that the eye sees."""
    common = {**gpu_scene.geometry, **parts.of(part, EYE), **all_slots(parts)}
    device.dispatch(MATTE, part.n, Materials=gpu_scene.materials["Materials"], **common)
    if gpu_scene.needs.principled:
        device.dispatch(PRINCIPLED, part.n, **gpu_scene.materials, **common, u_albedo=gpu_scene.table.table,
                        u_takes_all=False)


def evaluate_met(device: Device, gpu_scene: GpuScene, parts: Parts, part: Part, n: int, slots: Resources) -> None:
    """Fill in the points that paths met, of which few are left: by one program for all materials.

    slots  the resources of bind/list.glsl for n invocations
    """
    device.dispatch(PRINCIPLED, n, **gpu_scene.geometry, **gpu_scene.materials, **parts.of(part, parts.met), **slots,
                    u_albedo=gpu_scene.table.table, u_takes_all=True)


def all_slots(parts: Parts) -> Resources:
    """What bind/list.glsl reads for all slots of a part."""
    return {"List": parts.lists[0], "u_is_listed": False, "u_step": ONCE}
