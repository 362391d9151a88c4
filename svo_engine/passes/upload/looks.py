# SPDX-License-Identifier: GPL-3.0-or-later
"""What trees of nodes look like to all programs that do not evaluate them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...gpu.program import Resources
from ...gpu.scope import GpuScope


@dataclass(frozen=True, eq=False)
class Looks:
    """What was baked of materials that are trees.

    baked      what bind/baked.glsl reads beside the triangles
    brightest  the highest radiance that was baked
    means      (n_work,) f4, radiance of triangles whose material is a tree, if any of them shines; n_work counts
               triangles with instances
    emits      (n_materials,) bool: materials whose triangles stand in `means`
    """

    scope: GpuScope
    baked: Resources
    brightest: float
    means: np.ndarray | None
    emits: np.ndarray
