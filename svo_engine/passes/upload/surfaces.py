# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials on the device."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...needs import is_matte
from ...nodes.traits import Traits
from ...scene import layouts
from ...scene.types import Material
from .pictures import Pictures
from .trees import Trees


@dataclass(frozen=True, eq=False)
class Surfaces:
    """materials: the buffers of bind/materials.glsl."""

    scope: GpuScope
    materials: Resources


def upload_surfaces(device: Device, materials: tuple[Material, ...], pictures: Pictures, trees: Trees) -> Surfaces:
    """Copy the materials."""
    scope = device.scope()
    return Surfaces(scope, {"Materials": scope.buffer("materials", _materials(materials, trees)), **pictures.read})


def _materials(materials: tuple[Material, ...], trees: Trees | None = None) -> np.ndarray:
    rows = np.zeros(len(materials), layouts.dtype(layouts.MATERIAL))
    names = [name for name in rows.dtype.names or () if name not in ("program", "first_value", "detail")]
    for row, material in zip(rows, materials, strict=True):
        for name in names:
            row[name] = getattr(material, name)
        row["program"] = layouts.CONSTANTS["PROGRAM_MATTE" if is_matte(material) else "PROGRAM_PRINCIPLED"]
    if trees:
        structure = trees.compiled.structure_of
        rows["program"] = np.where(structure < 0, rows["program"], layouts.CONSTANTS["PROGRAM_TREE"] + structure)
        rows["first_value"] = trees.compiled.first_value
        rows["detail"] = [_detail(t) for t in trees.compiled.traits]
    return rows


def _detail(traits: Traits | None) -> float:
    """How finely a tree is baked; finer where shadows show its outlines."""
    return 0.0 if traits is None or not traits.varies else 4.0 if traits.passes else 1.0
