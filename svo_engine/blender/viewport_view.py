# SPDX-License-Identifier: GPL-3.0-or-later
"""What a 3D viewport looks through, and which part of it is rendered."""

from __future__ import annotations

import bpy
import numpy as np

from ..scene.camera import crop
from ..scene.types import View

Rect = tuple[int, int, int, int]
Box = tuple[float, float, float, float]

WHOLE: Box = (0.0, 0.0, 1.0, 1.0)


def view_of(context: bpy.types.Context, scene: bpy.types.Scene) -> tuple[View, Rect]:
    """The region's View and its rectangle (x, y, width, height) in pixels: all of it, or the render border in it."""
    region, region_data = context.region, context.region_data
    clip_from_view = np.array(region_data.window_matrix, "f8")
    box = _border(context.space_data, region_data, scene, clip_from_view)
    x, y, width, height = rect = _pixels(box, region.width, region.height)
    clip = crop(x / region.width, y / region.height, (x + width) / region.width, (y + height) / region.height)
    return View(np.array(region_data.view_matrix.inverted(), "f8"), clip @ clip_from_view, (width, height)), rect


def _border(space: bpy.types.SpaceView3D, region_data: bpy.types.RegionView3D, scene: bpy.types.Scene,
            clip_from_view: np.ndarray) -> Box:
    """(left, bottom, right, top) as fractions of the region. A camera's view obeys the camera's render border."""
    if region_data.view_perspective == "CAMERA":
        camera, render = space.camera if space.use_local_camera else scene.camera, scene.render
        if not render.use_border or camera is None or camera.type != "CAMERA":
            return WHOLE
        left, bottom, right, top = _camera_frame(camera.data, scene, clip_from_view)
        width, height = right - left, top - bottom
        return (left + render.border_min_x * width, bottom + render.border_min_y * height,
                left + render.border_max_x * width, bottom + render.border_max_y * height)
    if space.use_render_border:
        return (space.render_border_min_x, space.render_border_min_y,
                space.render_border_max_x, space.render_border_max_y)
    return WHOLE


def _camera_frame(camera: bpy.types.Camera, scene: bpy.types.Scene, clip_from_view: np.ndarray) -> Box:
    """Where the camera's picture lies in the region, as fractions of it."""
    corners = np.ones((4, 4))
    corners[:, :3] = camera.view_frame(scene=scene)
    clip = corners @ clip_from_view.T
    fractions = clip[:, :2] / clip[:, 3:] / 2 + 0.5
    return (*fractions.min(0).tolist(), *fractions.max(0).tolist())


def _pixels(box: Box, width: int, height: int) -> Rect:
    """`box` in whole pixels, inside the region, at least one each way."""
    left, right = (int(np.clip(round(f * width), 0, width)) for f in (box[0], box[2]))
    bottom, top = (int(np.clip(round(f * height), 0, height)) for f in (box[1], box[3]))
    left, bottom = min(left, width - 1), min(bottom, height - 1)
    return left, bottom, max(right - left, 1), max(top - bottom, 1)
