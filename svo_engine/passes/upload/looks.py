# SPDX-License-Identifier: GPL-3.0-or-later
"""What surfaces look like to all programs that do not evaluate trees of nodes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from .surfaces import Surfaces


@dataclass(frozen=True, eq=False)
class Looks:
    """Materials, and what was baked of those that are trees.

    surfaces   what all that evaluates itself reads
    baked      what bind/baked.glsl reads beside the triangles
    brightest  the highest radiance that was baked
    means      (n_work,) f4, radiance of triangles whose material is a tree, if any of them shines; n_work counts
               triangles with instances
    emits      (n_materials,) bool: materials whose triangles stand in `means`
    """

    scope: GpuScope
    surfaces: Surfaces
    baked: Resources
    brightest: float
    means: np.ndarray | None
    emits: np.ndarray

    @property
    def materials(self) -> Resources:
        """What bind/materials.glsl and bind/baked.glsl read."""
        return {**self.surfaces.materials, **self.baked}
