# SPDX-License-Identifier: GPL-3.0-or-later
"""Boxes around meshes and around all that is placed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from .types import Instances, Mesh


def mesh_boxes(meshes: Sequence[Mesh]) -> np.ndarray:
    """(n, 2, 3) f8, metres, object space: lowest and highest corner of each mesh; not finite without a vertex."""
    boxes = np.empty((len(meshes), 2, 3))
    for box, mesh in zip(boxes, meshes, strict=True):
        box[0], box[1] = mesh.positions.min(0, initial=np.inf), mesh.positions.max(0, initial=-np.inf)
    return boxes


def bounds(boxes: np.ndarray, instances: Instances) -> tuple[np.ndarray, np.ndarray]:
    """World-space box of all instances of meshes with those boxes: (lowest, highest), each (3,) f8, metres.

    Zeros where there is nothing.
    """
    boxes, matrices = boxes[instances.mesh], instances.world_from_object
    is_there = np.isfinite(boxes).all((1, 2))
    if not is_there.any():
        return np.zeros(3), np.zeros(3)
    (low, high), matrices = boxes[is_there].swapaxes(0, 1), matrices[is_there]
    centre, half = (low + high) / 2, (high - low) / 2
    centre_ws = (matrices[:, :3, :3] @ centre[..., None])[..., 0] + matrices[:, :3, 3]
    half_ws = (np.abs(matrices[:, :3, :3]) @ half[..., None])[..., 0]
    return (centre_ws - half_ws).min(0), (centre_ws + half_ws).max(0)
