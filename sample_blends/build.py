# SPDX-License-Identifier: GPL-3.0-or-later
"""Build the sample scenes: `python sample_blends/build.py [NAME ...] [--out DIR]`. Needs `bpy` 4.2 or later.

The committed files are built with bpy 4.2, the oldest version that we support: later ones open them, but 4.2 does not
fully open what 5.0 has saved. `README.md` says what each scene is for.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import bpy
from scenes import SCENES, lights

# No clamp, no denoising, no shortcut that changes the mean; the reference that the engine is measured against
CYCLES: dict[str, Any] = {
    "samples": 1024, "use_adaptive_sampling": False, "use_denoising": False, "seed": 0,
    "max_bounces": 12, "diffuse_bounces": 12, "glossy_bounces": 12, "transmission_bounces": 12,
    "transparent_max_bounces": 12, "sample_clamp_direct": 0.0, "sample_clamp_indirect": 0.0, "blur_glossy": 0.0,
    "light_sampling_threshold": 0.0, "pixel_filter_type": "BLACKMAN_HARRIS", "filter_width": 1.5,
}


def main() -> None:
    """Build the scenes that the command line names, all by default."""
    parser = argparse.ArgumentParser(description="Build the sample scenes.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"one of {', '.join(SCENES)}; default: all")
    parser.add_argument("--out", type=Path, default=Path(__file__).parent, help="folder for the .blend files")
    options = parser.parse_args()
    if unknown := [name for name in options.names if name not in SCENES]:
        parser.error(f"there is no scene '{unknown[0]}'; there are {', '.join(SCENES)}")
    if not options.out.is_dir():
        parser.error(f"there is no folder '{options.out}'")
    for name in options.names or SCENES:
        path = build(name, options.out)
        print(f"{path}: {path.stat().st_size / 1e3:.0f} kB")


def build(name: str, folder: Path) -> Path:
    """Build scene `name` and write it into `folder`, compressed, with nothing in it that points outside."""
    _new_scene(name)
    SCENES[name]()
    _arrange_windows()
    path = folder.resolve() / f"{name}.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True)
    return path


def _new_scene(name: str) -> None:
    """Forget everything, then make the file that all samples start from: 800x600, metres, Cycles without a bias."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.name = name
    scene.unit_settings.system = "METRIC"
    scene.unit_settings.length_unit = "METERS"
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 800, 600, 100
    scene.view_settings.view_transform = "Standard"
    scene.render.engine = "CYCLES"
    scene.render.filepath = "//"
    for setting, value in CYCLES.items():
        setattr(scene.cycles, setting, value)
    lights.world_color((0.0, 0.0, 0.0))


def _arrange_windows() -> None:
    """Let the 3D views look through the camera, and no file browser show the builder's home."""
    for space in (s for screen in bpy.data.screens for area in screen.areas for s in area.spaces):
        if space.type == "VIEW_3D":
            space.region_3d.view_perspective = "CAMERA"
        elif space.type == "FILE_BROWSER":
            space.params.directory = b"//"


if __name__ == "__main__":
    main()
