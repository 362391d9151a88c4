# SPDX-License-Identifier: GPL-3.0-or-later
"""What rays know of materials: which share of them each one stops. It stays while all else of materials is edited."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...nodes.traits import Traits
from ...scene import layouts
from ...scene.types import Material
from .looks import Looks
from .pictures import Pictures
from .placing import Placing

Given = tuple[tuple[float, int], ...]


@dataclass(frozen=True, eq=False)
class Opacity:
    """read: what bind/opacity.glsl reads. is_whole: no ray passes through anything."""

    scope: GpuScope
    read: Resources
    is_whole: bool


def alphas_of(materials: tuple[Material, ...], traits: tuple[Traits | None, ...]) -> Given:
    """(alpha, its texture or -1) of each material; of trees those that stop all rays, unless they are baked."""
    return tuple((m.alpha, m.alpha_texture) if t is None else (1.0, -1)
                 for m, t in zip(materials, traits, strict=True))


def upload_opacity(device: Device, placing: Placing, pictures: Pictures, alphas: Given, passes: tuple[bool, ...],
                   looks: Looks | None, skips: bool) -> Opacity:
    """Look at the materials of every instance. Without `skips` all count as cut out, which must change nothing.

    passes  of each material, whether it is a tree that lets rays pass; looks: what was baked, if any is
    """
    scope, inst = device.scope(), placing.placed
    rows = np.zeros(len(alphas), layouts.dtype(layouts.OPACITY))
    rows["alpha"], rows["alpha_texture"] = [a for a, _ in alphas], [texture for _, texture in alphas]
    has_alpha = (rows["alpha"] < 1) | (rows["alpha_texture"] >= 0) | np.array(passes, bool)
    of_slots = has_alpha[inst.slot_materials]
    found = np.logical_or.reduceat(of_slots, inst.first_slot[:-1]) if len(inst) else np.zeros(0, bool)
    flags = (found | (not skips))[placing.order].astype("u4")
    device.profiler.counts["cutouts"] = int(flags.sum())
    baked = looks.baked if looks else {"u_baked": None, "u_n_rows": 0}
    read: Resources = {**placing.instances, **pictures.read, **baked, "Opacities": scope.buffer("opacities", rows),
                       "Cutouts": scope.buffer("cutouts", flags), "u_sees_trees": False}
    return Opacity(scope, read, not has_alpha.any())
