# SPDX-License-Identifier: GPL-3.0-or-later
"""One RENDERED viewport: syncs and draws on the main thread, renders in a Worker, asks for redraws from a timer."""

from __future__ import annotations

import weakref
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import bpy

from ..film import Film
from ..scene.types import Scene
from . import present, session, told
from .properties import settings_of
from .render_passes import lines_of
from .sync import Sync, keep_picture
from .viewport_view import Rect, view_of
from .worker import Job, Worker

SECONDS_BETWEEN_POLLS = 1 / 60
_POLLS_TO_COMPARE = 60
_SECONDS_TO_CLOSE = 5.0
_open: list[Viewport] = []


class Viewport:
    """Belongs to one RenderEngine object, and closes itself when Blender has freed that.

    failure  the sentence on what went wrong in the last `update` or `draw`, or ""; the engine writes it
    """

    def __init__(self, engine: bpy.types.RenderEngine, describe: Callable[[Exception], str]) -> None:
        self.failure = ""
        self._engine = weakref.ref(engine)
        client = session.current.client()
        self._worker = Worker(client.films, describe, client.close)
        session.current.compile_all()  # whoever opens a viewport will edit
        self._sync = Sync()
        self._n_polls = 0
        self._scene: Scene | None = None
        self._unlit_scene: Scene | None = None
        self._texture: tuple[Film, Any] | None = None
        _open.append(self)
        if not bpy.app.timers.is_registered(_poll):
            bpy.app.timers.register(_poll, persistent=True)

    def update(self, context: bpy.types.Context, depsgraph: bpy.types.Depsgraph) -> None:
        """Take over what has changed; SceneError if the scene cannot be rendered."""
        self._worker.retry()
        last, self._scene = self._scene, None
        self._scene = keep_picture(last, self._sync.update(depsgraph, context.space_data))
        if self._scene is not last:
            self._unlit_scene = replace(self._scene, lights=())

    def draw(self, engine: bpy.types.RenderEngine, context: bpy.types.Context,
             depsgraph: bpy.types.Depsgraph) -> None:
        """Draw the newest film and order a better one."""
        if self._scene is not None and self._sync.is_stale(context.space_data):
            self.update(context, depsgraph)
        is_lit = context.space_data.shading.use_scene_lights_render
        if self._scene is None or (shown_scene := self._scene if is_lit else self._unlit_scene) is None:
            return
        self.failure = ""
        scene = depsgraph.scene
        view, rect = view_of(context, scene)
        settings = replace(settings_of(scene).for_viewport(), lines=lines_of(depsgraph.view_layer))
        self._worker.show(Job(shown_scene, view, settings, rect))
        if self._worker.shown is not None:
            job, film = self._worker.shown
            self.paint(engine, scene, film, job.rect)
            if told.keep(told.sentences_of(job.scene, film)):
                told.redraw_panels(context.screen)

    def paint(self, engine: bpy.types.RenderEngine, scene: bpy.types.Scene, film: Film, rect: Rect) -> None:
        """Show a film over `rect` of the region."""
        present.draw_texture(engine, scene, self._texture_of(film), rect)

    @property
    def status(self) -> tuple[str, str]:
        """How far the picture is, or what went wrong: the two texts of `RenderEngine.update_stats`."""
        if failure := self.failure or self._worker.failure:
            return "Error", failure
        if session.current.status and not self._worker.is_idle:
            return "", session.current.status
        if self._worker.shown is None:
            return "", "Preparing"
        job, film = self._worker.shown
        return next(iter(told.sentences_of(job.scene, film)), ""), f"Sample {film.n_samples}/{job.settings.samples}"

    @property
    def is_finished(self) -> bool:
        """Whether the picture will not get any better."""
        return self._worker.is_finished

    def poll(self) -> bool:
        """Ask Blender for a redraw if there is something new; False once Blender has freed the engine."""
        try:
            engine = self._engine()
            if engine is not None and (self._worker.take_news() or self._finds_edited_images()):
                engine.tag_redraw()
        except ReferenceError:
            engine = None
        return engine is not None

    def _finds_edited_images(self) -> bool:
        """Blender does not tell when pixels are set: look once a second."""
        self._n_polls += 1
        return self._n_polls % _POLLS_TO_COMPARE == 0 and self._sync.images.compare()

    def close(self) -> None:
        """End the worker."""
        self._worker.close()

    def join(self) -> None:
        """Wait for the worker's end."""
        self._worker.join(_SECONDS_TO_CLOSE)

    def _texture_of(self, film: Film) -> Any:
        if self._texture is None or self._texture[0] is not film:
            self._texture = film, present.make_texture(film)
        return self._texture[1]


def close_all() -> None:
    """End all viewports and wait for their threads."""
    closing, _open[:] = _open[:], []
    for viewport in closing:
        viewport.close()
    for viewport in closing:
        viewport.join()


def _poll() -> float | None:
    """The timer on the main thread: Blender's redraw must not be asked for from another one."""
    for viewport in _open[:]:
        if not viewport.poll():
            viewport.close()
            _open.remove(viewport)
    return SECONDS_BETWEEN_POLLS if _open else None
