# SPDX-License-Identifier: GPL-3.0-or-later
"""Projection as Blender does it: sensor fit, shift, pixel aspect, orthographic scale, render border."""

from __future__ import annotations

import numpy as np

from .types import Camera, View

Border = tuple[float, float, float, float]


def make_view(camera: Camera, size: tuple[int, int] | None = None, border: Border | None = None) -> View:
    """The view of `camera` for a picture of `size` pixels (default: the camera's own size).

    border: (left, bottom, right, top) as fractions of the picture; the view is then that part alone. Its edges lie on
    pixels as Blender's do: a fraction times the side in 32-bit floats, cut to an integer; at least one pixel is left.
    """
    width, height = size or camera.size
    clip = _clip_from_camera(camera, width, height)
    if border is not None:
        left, right = _pixel(border[0], width), _pixel(border[2], width)
        bottom, top = _pixel(border[1], height), _pixel(border[3], height)
        right, top = max(right, left + 1), max(top, bottom + 1)
        clip = crop(left / width, bottom / height, right / width, top / height) @ clip
        width, height = right - left, top - bottom
    return View(camera.world_from_camera, clip, (width, height))


def _clip_from_camera(camera: Camera, width: int, height: int) -> np.ndarray:
    """OpenGL projection (4, 4) f8. The fitted side of the sensor spans the fitted side of the picture."""
    aspect_x, aspect_y = width * camera.pixel_aspect[0], height * camera.pixel_aspect[1]
    fit = camera.sensor_fit
    if fit == "AUTO":
        fit = "HORIZONTAL" if aspect_x >= aspect_y else "VERTICAL"
        sensor = camera.sensor[0]
    else:
        sensor = camera.sensor[0] if fit == "HORIZONTAL" else camera.sensor[1]
    fitted_px = aspect_x if fit == "HORIZONTAL" else aspect_y
    near, far = camera.clip_start, camera.clip_end
    # Size of the fitted side on the near plane (perspective) or anywhere (orthographic), metres
    side = camera.ortho_scale if camera.is_orthographic else sensor * near / camera.lens
    half = np.array([aspect_x, aspect_y]) / fitted_px * side / 2
    centre = np.array(camera.shift) * side
    (left, bottom), (right, top) = centre - half, centre + half
    m = np.zeros((4, 4))
    m[0, 0], m[1, 1] = 2 / (right - left), 2 / (top - bottom)
    if camera.is_orthographic:
        m[0, 3], m[1, 3] = -(right + left) / (right - left), -(top + bottom) / (top - bottom)
        m[2, 2], m[2, 3], m[3, 3] = -2 / (far - near), -(far + near) / (far - near), 1
    else:
        m[0, 0], m[1, 1] = m[0, 0] * near, m[1, 1] * near
        m[0, 2], m[1, 2] = (right + left) / (right - left), (top + bottom) / (top - bottom)
        m[2, 2], m[2, 3], m[3, 2] = -(far + near) / (far - near), -2 * far * near / (far - near), -1
    return m


def _pixel(fraction: float, side: int) -> int:
    """The pixel edge at `fraction` of `side` pixels. In doubles 0.7 of 10 were 6, as Blender's 0.7 is 0.69999999."""
    return int(np.float32(fraction) * np.float32(side))


def crop(left: float, bottom: float, right: float, top: float) -> np.ndarray:
    """Clip-space matrix (4, 4) that stretches the part of the picture, in fractions, over the whole of it."""
    m = np.eye(4)
    m[0, 0], m[0, 3] = 1 / (right - left), (1 - left - right) / (right - left)
    m[1, 1], m[1, 3] = 1 / (top - bottom), (1 - bottom - top) / (top - bottom)
    return m
