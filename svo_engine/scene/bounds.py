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


def placed_boxes(boxes: np.ndarray, world_from_object: np.ndarray) -> np.ndarray:
    """(n, 2, 3) f8: world-space boxes around boxes (n, 2, 3) that matrices (n, 3 or 4, 4) place."""
    low, high = boxes.astype("f8").swapaxes(0, 1)
    linear, offset = world_from_object[:, :3, :3], world_from_object[:, :3, 3]
    centre = (linear @ ((low + high) / 2)[..., None])[..., 0] + offset
    half = (np.abs(linear) @ ((high - low) / 2)[..., None])[..., 0]
    return np.stack([centre - half, centre + half], 1)


def bounds(boxes: np.ndarray, instances: Instances) -> tuple[np.ndarray, np.ndarray]:
    """World-space box of all instances of meshes with those boxes: (lowest, highest), each (3,) f8, metres.

    Zeros where there is nothing.
    """
    boxes = boxes[instances.mesh]
    is_there = np.isfinite(boxes).all((1, 2))
    if not is_there.any():
        return np.zeros(3), np.zeros(3)
    placed = placed_boxes(boxes[is_there], instances.world_from_object[is_there])
    return placed[:, 0].min(0), placed[:, 1].max(0)
