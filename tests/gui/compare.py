# SPDX-License-Identifier: GPL-3.0-or-later
"""The comparison in a window: its picture comes into an Image Editor, Esc ends it earlier, all settings are kept."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import drive  # type: ignore[import-not-found]  # not on the path of a type checker


def settings():
    scene = drive.window().scene
    return scene.render.engine, scene.render.image_settings.file_format, scene.cycles.samples, scene.cycles.filter_width


def begin(samples: int) -> Path:
    folder = Path(tempfile.mkdtemp())
    with bpy.context.temp_override(window=drive.window()):
        assert bpy.ops.svo.compare(samples=samples, directory=str(folder)) == {"RUNNING_MODAL"}
    return folder


def is_over() -> bool:
    return not any(operator.bl_idname == "SVO_OT_compare" for operator in drive.window().modal_operators)


def shown() -> list[str]:
    windows = bpy.context.window_manager.windows
    areas = [area for window in windows for area in window.screen.areas if area.ui_type == "IMAGE_EDITOR"]
    return [bpy.path.abspath(area.spaces.active.image.filepath) for area in areas if area.spaces.active.image]


def script() -> drive.Script:
    drive.box()
    before = settings()
    for _ in range(2):
        folder = begin(samples=4)
        yield is_over
        assert {path.suffix for path in folder.iterdir()} == {".exr", ".png", ".json"}
        assert shown() == [str(folder / "comparison.png")]
        assert settings() == before
    yield 1.0
    drive.shot("comparison")

    folder = begin(samples=1_000_000)
    yield (folder / "svo.exr").exists
    yield 3.0
    drive.press("Escape")
    yield is_over
    assert not (folder / "cycles.exr").exists()
    assert settings() == before


drive.start(script())
