# SPDX-License-Identifier: GPL-3.0-or-later
"""The Render, World, Data and Material tabs with our engine, and a material's icon that our engine renders."""

from __future__ import annotations

import sys
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import drive  # type: ignore[import-not-found]  # not on the path of a type checker


def script() -> drive.Script:
    drive.box()
    with bpy.context.temp_override(window=drive.window(), area=drive.area("OUTLINER")):
        bpy.context.area.type = "PROPERTIES"
    tabs = [place.spaces.active for place in drive.window().screen.areas if place.type == "PROPERTIES"]
    yield 1.0
    for kind, thing in (("RENDER", "Suzanne"), ("OUTPUT", "Suzanne"), ("VIEW_LAYER", "Suzanne"), ("DATA", "Lamp"),
                        ("MATERIAL", "Suzanne"), ("DATA", "Camera")):
        drive.window().view_layer.objects.active = bpy.data.objects[thing]
        yield 0.5
        for tab in tabs:
            tab.context = kind
        yield 2.0
        drive.shot(f"tab-{kind}-{thing}".lower())

    material = bpy.data.materials["Left"]
    material.asset_mark()
    material.asset_generate_preview()
    yield lambda: material.preview is not None and any(material.preview.image_pixels_float)
    pixels = np.array(material.preview.image_pixels_float).reshape(*material.preview.image_size, 4)
    red, green, _, alpha = pixels[pixels[..., 3] > 0.5].mean(0)
    print(f"icon: {material.preview.image_size[:]} red {red:.3f} green {green:.3f}", flush=True)
    assert alpha > 0.5 and red > 1.5 * green, "the icon does not show the material"


drive.start(script())
