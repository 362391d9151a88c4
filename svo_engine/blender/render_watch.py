# SPDX-License-Identifier: GPL-3.0-or-later
"""A render that Blender is asked for: its time, whether it was stopped, and the image that shows it."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import closing, contextmanager

import bpy

from ..errors import Cancelled
from .host_errors import as_svo_errors


class RenderWatch:
    """The clock of one render, which also notices whether the user stops it. Made just before, closed after it."""

    def __init__(self) -> None:
        self._started, self._ended = time.perf_counter(), 0.0
        self._is_cancelled = False
        bpy.app.handlers.render_complete.append(self._on_complete)
        bpy.app.handlers.render_cancel.append(self._on_cancel)

    def close(self) -> None:
        """Stop watching."""
        bpy.app.handlers.render_complete.remove(self._on_complete)
        bpy.app.handlers.render_cancel.remove(self._on_cancel)

    def seconds(self) -> float:
        """Between start and end; Cancelled if the user has stopped the render."""
        if self._is_cancelled:
            raise Cancelled("The comparison was cancelled")
        return (self._ended or time.perf_counter()) - self._started

    def _on_complete(self, *_: object) -> None:
        self._ended = time.perf_counter()

    def _on_cancel(self, *_: object) -> None:
        self._is_cancelled = True


def seconds_of_render(scene: bpy.types.Scene) -> float:
    """Render, waiting for the end. SvoError if Blender says that it failed, Cancelled if it was stopped."""
    with closing(RenderWatch()) as watch, as_svo_errors():
        bpy.ops.render.render(scene=scene.name)
    return watch.seconds()


def render_result() -> str:
    """Name of the image that shows renders; empty before the first one."""
    return next((image.name for image in bpy.data.images if image.type == "RENDER_RESULT"), "")


@contextmanager
def no_new_render_result() -> Iterator[None]:
    """Leave no Render Result behind where there was none."""
    had_one = bool(render_result())
    try:
        yield
    finally:
        if not had_one and (name := render_result()):
            bpy.data.images.remove(bpy.data.images[name])
