# SPDX-License-Identifier: GPL-3.0-or-later
"""A Film to where Blender shows it: a render result's pass, or a texture that the viewport draws."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from ..film import Film
from .render_passes import blender_name

# The largest finite 16-bit float: a brighter pixel would turn into infinity, which the view transform cannot show
_LARGEST_HALF = 65504.0


def fill_result(result: bpy.types.RenderResult, film: Film, view: str = "") -> None:
    """Copy the film's planes into the passes of `result` for the stereo view `view` ("": there is only one)."""
    passes = result.layers[0].passes
    for name, plane in film.planes.items():
        if (render_pass := passes.find_by_name(blender_name(name), view)) is not None:
            # One flat array of 32-bit floats: Blender copies that at once, and anything else value by value
            render_pass.rect.foreach_set(np.ascontiguousarray(plane, "f4").ravel())


def make_texture(film: Film) -> Any:
    """A GPUTexture (RGBA16F, scene-linear, premultiplied) of the picture. Main thread only, while Blender draws."""
    import gpu  # its drawing part exists in a Blender with a window only

    pixels = np.clip(film.planes["Combined"], -_LARGEST_HALF, _LARGEST_HALF).astype("f4")
    buffer = gpu.types.Buffer("FLOAT", pixels.size, pixels.ravel())
    return gpu.types.GPUTexture(film.size, format="RGBA16F", data=buffer)


def draw_texture(engine: bpy.types.RenderEngine, scene: bpy.types.Scene, texture: Any,
                 rect: tuple[int, int, int, int]) -> None:
    """Draw `texture` over `rect` (x, y, width, height in pixels of the region); Blender applies the view transform."""
    import gpu
    from gpu_extras.presets import draw_texture_2d

    gpu.state.blend_set("ALPHA_PREMULT")
    engine.bind_display_space_shader(scene)
    draw_texture_2d(texture, rect[:2], rect[2], rect[3])
    engine.unbind_display_space_shader()
    gpu.state.blend_set("NONE")
