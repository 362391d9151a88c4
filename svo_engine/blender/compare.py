# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator `svo.compare`: our engine beside Cycles. Blender waits until both renders are done."""

from __future__ import annotations

from pathlib import Path

import bpy

from ..errors import Cancelled, SvoError
from .comparison import compare
from .runs import cycles_run, svo_run


class SVO_OT_compare(bpy.types.Operator):
    """Render this frame with SVO and with Cycles at equal settings, and measure how far they are apart"""

    bl_idname = "svo.compare"
    bl_label = "Compare with Cycles"
    bl_options = {"REGISTER"}

    samples: bpy.props.IntProperty(name="Cycles Samples", default=256, min=1, soft_max=65536,
                                   description="Samples of each pixel in the reference")
    bounces: bpy.props.IntProperty(name="Bounces", default=-1, min=-1, max=1024,
                                   description="Bounces of every kind in the reference; -1 takes Cycles' own settings")
    directory: bpy.props.StringProperty(name="Folder", subtype="DIR_PATH",
                                        description="Where all results go; empty: 'comparison' beside the file")

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        return context.window_manager.invoke_props_dialog(self, width=400)

    def execute(self, context: bpy.types.Context) -> set[str]:
        manager, scene = context.window_manager, context.scene
        manager.progress_begin(0, 2)
        try:
            reference = cycles_run(scene, self.samples, self.bounces if self.bounces >= 0 else None)
            found = compare(scene, context.view_layer, self._folder(), svo_run(), reference, manager.progress_update)
        except Cancelled as cancelled:
            self.report({"WARNING"}, str(cancelled))
            return {"CANCELLED"}
        except SvoError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            manager.progress_end()
        self.report({"INFO"}, f"SVO and Cycles: {found.sentence()} ({found.picture})")
        _show(context, found.picture)
        return {"FINISHED"}

    def _folder(self) -> Path:
        if self.directory:
            return Path(bpy.path.abspath(self.directory))
        return Path(bpy.path.abspath("//") if bpy.data.is_saved else bpy.app.tempdir, "comparison")


def _show(context: bpy.types.Context, picture: Path) -> None:
    """In an Image Editor that is open, or else in a window of its own. Without a window: nowhere."""
    if context.window is None or bpy.app.background:
        return
    image = bpy.data.images.load(str(picture), check_existing=True)
    image.reload()
    areas = [area for window in context.window_manager.windows for area in window.screen.areas]
    area = next((area for area in areas if area.ui_type == "IMAGE_EDITOR"), None)
    if area is None:
        bpy.ops.wm.window_new()
        area = context.window_manager.windows[-1].screen.areas[0]
        area.ui_type = "IMAGE_EDITOR"
    area.spaces.active.image = image


def register() -> None:
    """Make Blender list the operator."""
    bpy.utils.register_class(SVO_OT_compare)


def unregister() -> None:
    """Take it out again."""
    bpy.utils.unregister_class(SVO_OT_compare)
