# SPDX-License-Identifier: GPL-3.0-or-later
"""A viewport without a window, edited, and who was held up meanwhile: what the benchmark measures of edits.

The viewport is told of changes as Blender tells one, polls as its timer does, and draws when it asks for it. Only the
texture stays unmade, for which there must be a window.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import bpy

from ..errors import SvoError
from ..film import Film
from . import session
from .edit_acts import Act, acts
from .viewport import SECONDS_BETWEEN_POLLS, Viewport

_NAP = 0.002  # of the bystander
_LONGEST = 300.0  # seconds until a picture counts as never coming


@dataclass(frozen=True)
class Seen:
    """Seconds: until the first picture and the last one, the longest in our code on the main thread, the longest that
    the bystander was held; nan: there was none. n_programs: compiled, the most of any frame."""

    first: float
    final: float
    main: float
    held: float
    n_programs: int


class Bystander:
    """A thread of Python that has nothing to do with rendering, as Blender's panels have: how long it is held up."""

    def __init__(self) -> None:
        self.longest, self._is_over = 0.0, False
        self._thread = threading.Thread(target=self._watch, name="SVO bystander", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End it."""
        self._is_over = True
        self._thread.join()

    def _watch(self) -> None:
        while not self._is_over:
            start = time.perf_counter()
            time.sleep(_NAP)
            self.longest = max(self.longest, time.perf_counter() - start - _NAP)


class Windowless(Viewport):
    """Notes what it would draw. film: the last one, n_programs: the most that a film of those needed."""

    film: Film | None = None
    n_programs = 0

    def paint(self, engine: Any, scene: bpy.types.Scene, film: Film, rect: tuple[int, int, int, int]) -> None:
        self.film = film
        self.n_programs = max(self.n_programs, film.stats["counts"]["programs compiled"])


class _Engine:
    """What a viewport uses of its RenderEngine."""

    is_tagged = False

    def tag_redraw(self) -> None:
        self.is_tagged = True


class Watch:
    """Edits `scene` in front of a viewport of `size` pixels that looks through the scene's camera."""

    def __init__(self, scene: bpy.types.Scene, size: tuple[int, int]) -> None:
        self._scene, self._size = scene, size
        self._main = 0.0
        self._shift = 0.0
        self._bystander = Bystander()
        self._open()
        bpy.app.handlers.depsgraph_update_post.append(self._follow)

    def close(self) -> None:
        """End all."""
        bpy.app.handlers.depsgraph_update_post.remove(self._follow)
        self._bystander.close()
        self._viewport.close()
        self._viewport.join()

    def acts(self) -> dict[str, Act]:
        """All that can be done to the scene in front of the viewport."""
        return {"camera": Act(self._look), **acts(self._scene), "engine switched to and fro": Act(self._reopen)}

    def see(self, act: Callable[[], object]) -> Seen:
        """Do it, and follow the viewport until its picture is finished. SvoError if it fails."""
        self._main, self._bystander.longest, self._viewport.n_programs = 0.0, 0.0, 0
        before, first, start = self._viewport.film, math.nan, time.perf_counter()
        act()
        bpy.context.view_layer.update()
        self._draw()
        is_finished = False
        while not is_finished:
            is_finished = self._viewport.is_finished
            time.sleep(SECONDS_BETWEEN_POLLS)
            self._timed(self._viewport.poll)
            if self._engine.is_tagged:
                self._draw()
            if math.isnan(first) and self._viewport.film not in (before, None):
                first = time.perf_counter() - start
            if self._viewport.status[0] == "Error" or time.perf_counter() - start > _LONGEST:
                raise SvoError(f"The viewport has no picture: {self._viewport.status[1]}")
        final = time.perf_counter() - start if math.isfinite(first) else math.nan
        return Seen(first, final, self._main, self._bystander.longest, self._viewport.n_programs)

    def see_render(self, samples: int) -> Seen:
        """F12 with so many samples; there is but one picture, and the main thread is Blender's."""
        self._scene.svo.samples = samples
        self._bystander.longest = 0.0
        start = time.perf_counter()
        bpy.ops.render.render()
        seconds = time.perf_counter() - start
        n_programs = session.last_stats["counts"]["programs compiled"]
        return Seen(math.nan, seconds, math.nan, self._bystander.longest, n_programs)

    def _open(self) -> None:
        self._engine = _Engine()
        self._viewport = Windowless(self._engine, str)
        self._timed(lambda: self._viewport.update(self._context(), bpy.context.evaluated_depsgraph_get()))

    def _reopen(self, _number: int) -> None:
        self._viewport.close()
        self._viewport.join()
        self._open()

    def _look(self, number: int) -> None:
        """From a little beside."""
        self._shift = 1e-3 * number

    def _follow(self, _scene: Any, depsgraph: bpy.types.Depsgraph) -> None:
        if depsgraph.mode == "VIEWPORT":
            self._timed(lambda: self._viewport.update(self._context(), depsgraph))

    def _draw(self) -> None:
        self._engine.is_tagged = False
        graph = bpy.context.evaluated_depsgraph_get()
        self._timed(lambda: self._viewport.draw(self._engine, self._context(), graph))

    def _timed(self, work: Callable[[], object]) -> None:
        start = time.perf_counter()
        work()
        self._main = max(self._main, time.perf_counter() - start)

    def _context(self) -> Any:
        """Like that of a 3D viewport; its space is a real one, for it alone can tell what it hides."""
        camera, (width, height) = self._scene.camera, self._size
        graph = bpy.context.evaluated_depsgraph_get()
        view = camera.matrix_world.inverted()
        view.translation.x += self._shift
        region_data = SimpleNamespace(window_matrix=camera.calc_matrix_camera(graph, x=width, y=height),
                                      view_matrix=view, view_perspective="PERSP")
        return SimpleNamespace(region=SimpleNamespace(width=width, height=height), region_data=region_data,
                               space_data=_space())


def _space() -> bpy.types.SpaceView3D:
    screen = bpy.context.window_manager.windows[0].screen
    return next(space for area in screen.areas if area.type == "VIEW_3D" for space in area.spaces
                if space.type == "VIEW_3D")


@contextmanager
def watched(scene: bpy.types.Scene, size: tuple[int, int]) -> Iterator[Watch]:
    """A Watch whose first picture is finished, all programs compiled before."""
    session.current.compile_now()
    scene.render.engine = "SVO_ENGINE"
    scene.svo.viewport_adaptive_sampling = False  # so that the last sample is known
    _space().shading.use_scene_lights_render = True
    watch = Watch(scene, size)
    try:
        watch.see(lambda: None)
        yield watch
    finally:
        watch.close()
