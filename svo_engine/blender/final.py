# SPDX-License-Identifier: GPL-3.0-or-later
"""The final render of one view layer: for F12, an animation, the command line of Blender and material previews."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import bpy
import numpy as np

from ..scene.camera import make_view
from ..scene.types import Scene, View
from ..settings import RenderSettings
from . import present, session, told
from .extract import border, extract
from .extract.camera import read_camera
from .properties import settings_of
from .render_passes import lines_of, passes_of
from .sync import Sync
from .sync.changes import Uid, uid_of

# A preview is an icon or a small sphere: it must come at once
_PREVIEW_SETTINGS = RenderSettings(samples=4, cache_resolution="32", bounces=2)
_UPDATE_SECONDS = 0.3  # between pictures for whoever watches
_kept: dict[Uid, Sync] = {}


@dataclass(frozen=True, eq=False)
class Frame:
    """What `render_frame` needs: all of Blender's scene data, already copied, except the cameras' places.

    extract_ms  what that took
    """

    scene: Scene
    settings: RenderSettings
    border: tuple[float, float, float, float] | None
    layer: str
    extract_ms: float


def extract_frame(engine: bpy.types.RenderEngine, depsgraph: bpy.types.Depsgraph) -> Frame:
    """Copy the scene, while Blender keeps it still. SceneError if it cannot be rendered."""
    start, settings = time.perf_counter(), _PREVIEW_SETTINGS
    if not engine.is_preview:
        passes = passes_of(depsgraph.scene, depsgraph.view_layer)
        settings = replace(settings_of(depsgraph.scene), passes=passes, lines=lines_of(depsgraph.view_layer))
    scene = extract(depsgraph) if engine.is_preview else _sync_of(depsgraph.scene).read(depsgraph)
    extract_ms = (time.perf_counter() - start) * 1e3
    return Frame(scene, settings, border(depsgraph.scene), depsgraph.view_layer.name, extract_ms)


def forget() -> None:
    """Give up what the last render has read."""
    _kept.clear()


def _sync_of(scene: bpy.types.Scene) -> Sync:
    """Of the scene that was rendered last. Blender makes a new depsgraph for each render and tells nothing of what has
    changed: all is read, but what is the same as before stays the same object."""
    uid = uid_of(scene.original)
    if uid not in _kept:
        _kept.clear()
        _kept[uid] = Sync()
    return _kept[uid]


def render_frame(engine: bpy.types.RenderEngine, frame: Frame) -> None:
    """Render every stereo view of the frame into its result. Cancelled if the user stops it."""
    for name in [view.name for view in engine.get_result().views]:
        engine.active_view_set(name)
        _render_view(engine, frame, name, _view_of(engine, frame))


def _view_of(engine: bpy.types.RenderEngine, frame: Frame) -> View:
    """What the active stereo view looks through: a camera of its own, or the scene's, moved and shifted for an eye."""
    owner = engine.camera_override
    camera = read_camera(owner, engine.render, lambda _warning: None)
    camera = replace(camera, world_from_camera=np.array(engine.camera_model_matrix(owner), "f8"),
                     shift=(engine.camera_shift_x(owner), owner.data.shift_y))
    return make_view(camera, (engine.resolution_x, engine.resolution_y), frame.border)


def _watch(engine: bpy.types.RenderEngine) -> Callable[[], bool]:
    """What is asked while the device works: whether to stop. It also tells how far shaders are compiled."""
    told = ""

    def should_stop() -> bool:
        nonlocal told
        if (status := session.current.status) != told:
            told = status
            engine.update_stats("", status or "Rendering")
        return bool(engine.test_break())

    return should_stop


def _render_view(engine: bpy.types.RenderEngine, frame: Frame, name: str, view: View) -> None:
    """Render one view; whatever there is when it ends, also by an error or a cancel, stays in the result."""
    engine.update_stats("", "Preparing")
    result = engine.begin_result(0, 0, *view.size, layer=frame.layer, view=name)
    client = session.client("preview" if engine.is_preview else "final")
    film, interval, hand_over_ms = None, math.inf if bpy.app.background else _UPDATE_SECONDS, 0.0
    try:
        for film in client.films(frame.scene, view, frame.settings, _watch(engine), interval):
            start = time.perf_counter()
            present.fill_result(result, film, name)
            engine.update_result(result)
            hand_over_ms += (time.perf_counter() - start) * 1e3
            engine.update_progress(film.n_samples / frame.settings.samples)
            engine.update_stats("", f"Sample {film.n_samples}/{frame.settings.samples}")
    finally:
        engine.end_result(result, cancel=film is None)
    if film is not None and not engine.is_preview:
        session.keep_stats(film, {"extract": frame.extract_ms, "hand over": hand_over_ms})
        told.keep(told.sentences_of(frame.scene, film))
        for limit in film.stats.get("limits", ()):
            engine.report({"WARNING"}, limit)
