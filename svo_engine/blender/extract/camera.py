# SPDX-License-Identifier: GPL-3.0-or-later
"""The camera, and the part of the picture that is rendered."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ...errors import SceneError
from ...scene.camera import Border
from ...scene.types import Camera


def read_camera(owner: Any, render: Any, warn: Callable[[str], object]) -> Camera:
    """The camera of the evaluated object `owner`, for a picture as the RenderSettings `render` have it."""
    data = owner.data
    if owner.type != "CAMERA":
        raise SceneError(f"Object '{owner.name}' is the scene's camera, but it is no camera object")
    if data.type not in ("PERSP", "ORTHO"):
        warn(f"Camera '{owner.name}' is panoramic, which is not supported; it is drawn as a perspective one")
    if data.dof.use_dof:
        warn(f"Camera '{owner.name}': depth of field is left out")
    return Camera(
        name=owner.name, world_from_camera=_without_scale(owner), size=_size(render),
        pixel_aspect=(render.pixel_aspect_x, render.pixel_aspect_y), is_orthographic=data.type == "ORTHO",
        lens=data.lens, sensor=(data.sensor_width, data.sensor_height), sensor_fit=data.sensor_fit,
        ortho_scale=data.ortho_scale, shift=(data.shift_x, data.shift_y), clip_start=data.clip_start,
        clip_end=data.clip_end)


def border(scene: Any) -> Border | None:
    """(left, bottom, right, top) of the render border as fractions of the picture; None if all of it is rendered."""
    render = scene.render
    if not render.use_border:
        return None
    return render.border_min_x, render.border_min_y, render.border_max_x, render.border_max_y


def _size(render: Any) -> tuple[int, int]:
    """(width, height) in pixels, cut to integers as Blender does."""
    width, height = (side * render.resolution_percentage // 100 for side in (render.resolution_x, render.resolution_y))
    return max(width, 1), max(height, 1)


def _without_scale(owner: Any) -> np.ndarray:
    """(4, 4) f8: the object's axes at length 1, mirrored if its scale is negative, as Blender looks through it."""
    matrix = np.array(owner.matrix_world, "f8")
    lengths = np.linalg.norm(matrix[:3, :3], axis=0)
    if lengths.min() == 0:
        raise SceneError(f"Camera '{owner.name}' has a scale of zero")
    matrix[:3, :3] /= lengths
    return matrix
