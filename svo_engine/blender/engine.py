# SPDX-License-Identifier: GPL-3.0-or-later
"""The render engine that Blender sees. Here, and only here, errors become one sentence for the user."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager

import bpy

from ..errors import Cancelled, SvoError
from . import render_passes
from .final import Frame, extract_frame, render_frame
from .viewport import Viewport

_log = logging.getLogger(__name__)


class SVORenderEngine(bpy.types.RenderEngine):
    """Blender makes one object for each frame (or keeps it, with persistent data) and one for each viewport, and may
    call `__init__` twice: all that lasts lives in `session.py`."""

    bl_idname = "SVO_ENGINE"
    bl_label = "SVO"
    bl_use_preview = True
    bl_use_eevee_viewport = True  # for Material Preview
    bl_use_gpu_context = False  # ours has its own thread
    bl_use_shading_nodes_custom = False  # our materials are the nodes of Cycles and EEVEE

    _frame: Frame | None = None
    _viewport: Viewport | None = None

    def update(self, _data: bpy.types.BlendData, depsgraph: bpy.types.Depsgraph) -> None:
        """Before each `render` of a view layer; Blender keeps the scene still meanwhile."""
        with self._telling_errors():
            self._frame = extract_frame(self, depsgraph)

    def render(self, _depsgraph: bpy.types.Depsgraph) -> None:
        """The final render of a view layer, in a thread of Blender's if there is a window."""
        frame, self._frame = self._frame, None
        if frame is None:  # `update` has told why
            return
        with self._telling_errors():
            for warning in () if self.is_preview else frame.scene.warnings:
                self.report({"WARNING"}, warning)
            render_frame(self, frame)

    def update_render_passes(self, scene: bpy.types.Scene, renderlayer: bpy.types.ViewLayer) -> None:
        """Whenever Blender needs to know which passes a view layer will have."""
        render_passes.list_passes(self, scene, renderlayer)

    def view_update(self, context: bpy.types.Context, depsgraph: bpy.types.Depsgraph) -> None:
        """Once for a new viewport, and after each change of the scene."""
        if self._viewport is None:
            self._viewport = Viewport(self, _sentence)
        with _noting_errors(self._viewport):
            self._viewport.update(context, depsgraph)

    def view_draw(self, context: bpy.types.Context, depsgraph: bpy.types.Depsgraph) -> None:
        """At each redraw."""
        if self._viewport is not None:
            with _noting_errors(self._viewport):
                self._viewport.draw(self, context, depsgraph)
            self.update_stats(*self._viewport.status)

    @contextmanager
    def _telling_errors(self) -> Iterator[None]:
        """A report makes `bpy.ops.render.render` fail and stands in the Info editor; `error_set` fails the render."""
        try:
            yield
        except Cancelled:
            return
        except Exception as error:  # noqa: BLE001 - Blender would print it and call the render finished
            sentence = _sentence(error)
            self.report({"ERROR"}, sentence)
            self.error_set(sentence)


@contextmanager
def _noting_errors(viewport: Viewport) -> Iterator[None]:
    """A viewport has nothing but its line of text to tell an error in."""
    try:
        yield
    except Exception as error:  # noqa: BLE001 - Blender would print it, at every redraw
        viewport.failure = _sentence(error)


def _sentence(error: Exception) -> str:
    """What the user is told. An error that is no SvoError is a mistake of ours: the console gets its traceback."""
    if isinstance(error, SvoError):
        return str(error)
    _log.error("Internal error", exc_info=error)
    return f"SVO has met an internal error, {type(error).__name__}: {error} (the console has the traceback)"


def register() -> None:
    """Make Blender list the engine."""
    bpy.utils.register_class(SVORenderEngine)


def unregister() -> None:
    """Take it out again; Blender ends its running renders and viewports first."""
    bpy.utils.unregister_class(SVORenderEngine)
