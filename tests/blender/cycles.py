# SPDX-License-Identifier: GPL-3.0-or-later
"""Tiny Cycles renders: the truth that conversions are held against."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import OpenEXR

# Nothing that drops or bends light
SETTINGS = {
    "device": "CPU", "seed": 0, "max_bounces": 0, "pixel_filter_type": "BLACKMAN_HARRIS", "use_denoising": False,
    "use_adaptive_sampling": False, "use_light_tree": False, "light_sampling_threshold": 0.0,
    "sample_clamp_direct": 0.0, "sample_clamp_indirect": 0.0}


def render(folder: Path, *, size: tuple[int, int] = (4, 4), samples: int = 64,
           filter_width: float = 1.0) -> np.ndarray:
    """The open scene through its camera in scene-linear RGBA (height, width, 4) f4, row 0 at the bottom.

    No light bounces. Samples lie within `filter_width` pixels around the pixel's centre.
    """
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    for name, value in (SETTINGS | {"samples": samples, "filter_width": filter_width}).items():
        setattr(scene.cycles, name, value)
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(folder / "cycles.exr")
    assert bpy.ops.render.render(write_still=True) == {"FINISHED"}
    with OpenEXR.File(scene.render.filepath) as file:
        channels = file.channels()
        found = channels["RGBA"] if "RGBA" in channels else channels["RGB"]
        return np.array(found.pixels[::-1], "f4")


def look_down(width=0.01, height=0.05):
    """An orthographic camera over the origin that sees `width` metres from `height` metres above."""
    data = bpy.data.cameras.new("Camera")
    data.type, data.ortho_scale, data.clip_start = "ORTHO", width, height / 100
    made = bpy.data.objects.new("Camera", data)
    made.location = (0, 0, height)
    bpy.context.scene.collection.objects.link(made)
    bpy.context.scene.camera = made
    return made
