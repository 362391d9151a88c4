# SPDX-License-Identifier: GPL-3.0-or-later
"""Which instances may let rays through."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...gpu.buffer import Buffer
from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from .looks import Looks
from .placing import Placing


@dataclass(frozen=True, eq=False)
class Cutouts:
    """flags: a buffer u4, in the device's order of instances; 0 where every ray is stopped."""

    scope: GpuScope
    flags: Buffer


def opacity_of(placing: Placing, looks: Looks, cutouts: Cutouts) -> Resources:
    """What bind/opacity.glsl reads: all that rays know of materials."""
    return {**placing.instances, **looks.opacity, "Cutouts": cutouts.flags, "u_sees_trees": False}


def mark_cutouts(device: Device, placing: Placing, looks: Looks, skips: bool) -> Cutouts:
    """Look at the materials of every instance. Without `skips` all count as cut out, which must change nothing."""
    scope = device.scope()
    inst = placing.placed
    of_slots = looks.has_alpha[inst.slot_materials]
    found = np.logical_or.reduceat(of_slots, inst.first_slot[:-1]) if len(inst) else np.zeros(0, bool)
    flags = (found | (not skips))[placing.order].astype("u4")
    device.profiler.counts["cutouts"] = int(flags.sum())
    return Cutouts(scope, scope.buffer("cutouts", flags))
