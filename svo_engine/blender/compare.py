# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator `svo.compare`: our engine beside Cycles. In a window both render as F12 does, with progress and Esc."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import ExitStack
from pathlib import Path
from typing import Self

import bpy

from ..errors import Cancelled, SvoError
from .comparison import Comparison, compare, steps
from .host_errors import as_svo_errors
from .render_watch import RenderWatch
from .runs import cycles_run, svo_run

_POLL_SECONDS = 0.1


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
        scene, bounces = context.scene, self.bounces if self.bounces >= 0 else None
        what = scene, context.view_layer, self._folder(), svo_run(), cycles_run(scene, self.samples, bounces)
        self._until_end = ExitStack()
        if bpy.app.background or context.window is None:
            return self._attempt(context, lambda: compare(*what))
        job = self._until_end.enter_context(Job(scene, steps(*what)))
        timer = context.window_manager.event_timer_add(_POLL_SECONDS, window=context.window)
        self._until_end.callback(context.window_manager.event_timer_remove, timer)
        context.window_manager.modal_handler_add(self)
        self._advance = job.advance
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        return self._attempt(context, self._advance) if event.type == "TIMER" else {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Blender closes the file or itself."""
        self._until_end.close()

    def _attempt(self, context: bpy.types.Context, step: Callable[[], Comparison | None]) -> set[str]:
        """Take one step, and tell what came of it."""
        with self._until_end.pop_all() as until_end:
            try:
                found = step()
            except Cancelled as cancelled:
                self.report({"WARNING"}, str(cancelled))
                return {"CANCELLED"}
            except SvoError as error:
                self.report({"ERROR"}, str(error))
                return {"CANCELLED"}
            if found is None:
                self._until_end = until_end.pop_all()
                return {"RUNNING_MODAL"}
        self.report({"INFO"}, f"SVO and Cycles: {found.sentence()} ({found.picture})")
        _show(context, found.picture)
        return {"FINISHED"}

    def _folder(self) -> Path:
        if self.directory:
            return Path(bpy.path.abspath(self.directory))
        return Path(bpy.path.abspath("//") if bpy.data.is_saved else bpy.app.tempdir, "comparison")


class Job:
    """A comparison whose renders run in Blender's background; its end, whatever brings it, puts the scene back."""

    def __init__(self, scene: bpy.types.Scene, todo: Generator[None, float, Comparison]) -> None:
        self._scene, self._todo = scene, todo
        self._watch: RenderWatch | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._watch is not None:
            self._watch.close()
        self._todo.close()

    def advance(self) -> Comparison | None:
        """Begin the next render unless one is running; what was found, once all is done."""
        if bpy.app.is_job_running("RENDER"):
            return None
        try:
            if self._watch is None:
                next(self._todo)
            else:
                self._todo.send(self._watch.seconds())
                self._watch.close()
        except StopIteration as done:
            return done.value
        self._watch = RenderWatch()
        with as_svo_errors():
            bpy.ops.render.render("INVOKE_DEFAULT", scene=self._scene.name)
        return None


def _show(context: bpy.types.Context, picture: Path) -> None:
    """In an Image Editor that is open, or else in a window of its own. Without a window: nowhere."""
    if context.window is None or bpy.app.background:
        return
    image = bpy.data.images.load(str(picture), check_existing=True)
    image.reload()
    windows = context.window_manager.windows
    editors = [(window, area) for window in windows for area in window.screen.areas if area.ui_type == "IMAGE_EDITOR"]
    if not editors:
        bpy.ops.wm.window_new()
        editors = [(windows[-1], windows[-1].screen.areas[0])]
        editors[0][1].ui_type = "IMAGE_EDITOR"
    window, area = editors[0]
    area.spaces.active.image = image
    region = next(region for region in area.regions if region.type == "WINDOW")
    with context.temp_override(window=window, area=area, region=region):
        bpy.ops.image.view_all(fit_view=True)


def register() -> None:
    """Make Blender list the operator."""
    bpy.utils.register_class(SVO_OT_compare)


def unregister() -> None:
    """Take it out again."""
    bpy.utils.unregister_class(SVO_OT_compare)
