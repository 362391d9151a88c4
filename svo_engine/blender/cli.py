# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command line does with a .blend: open it, never write it, with our engine registered meanwhile."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from dataclasses import asdict
from functools import reduce
from pathlib import Path
from typing import Any

import bpy

from ..errors import SceneError, SvoError
from ..scene.types import Scene
from ..settings import RenderSettings, with_text
from . import register, session, unregister
from .comparison import Comparison
from .comparison import compare as compare_runs
from .extract import extract
from .host_errors import as_svo_errors
from .properties import settings_of
from .render_passes import ask_for
from .render_watch import render_result
from .runs import cycles_run, svo_run

Texts = Sequence[tuple[str, str]]
Size = tuple[int, int] | None

_FORMATS = {".png": {"media_type": "IMAGE", "file_format": "PNG"},
            ".exr": {"media_type": "IMAGE", "file_format": "OPEN_EXR", "color_depth": "32"}}
_LAYERED = {"media_type": "MULTI_LAYER_IMAGE", "file_format": "OPEN_EXR_MULTILAYER"}


def render(file: Path, pictures: Sequence[Path], texts: Texts, size: Size, frame: int | None) -> dict[str, Any]:
    """Render as F12 would, with Blender's colour management and file formats; what `Film.stats` has and the settings.

    texts: (name, value) of settings that are not to be the file's own. SvoError if there is no picture.
    """
    with opened(file, texts, size, frame) as (scene, warnings):
        scene.render.engine = "SVO_ENGINE"
        scene.render.filepath = str(pictures[0].resolve())
        is_layered = any(name == "passes" for name, _ in texts)
        _set_format(scene, pictures[0], is_layered)
        with as_svo_errors():
            bpy.ops.render.render(write_still=True)
        if not session.last_stats:
            raise SvoError(f"There is no picture of '{file}'")
        for path in pictures[1:]:
            _set_format(scene, path, is_layered)
            with as_svo_errors():
                bpy.data.images[render_result()].save_render(str(path.resolve()), scene=scene)
        full, percentage = (scene.render.resolution_x, scene.render.resolution_y), scene.render.resolution_percentage
        return {"settings": asdict(settings_of(scene)), "size": [n * percentage // 100 for n in full],
                "warnings": warnings(), **session.last_stats}


def extract_scene(file: Path, frame: int | None) -> Scene:
    """The scene as a final render of the active view layer would see it. SvoError if it cannot be rendered."""
    with opened(file, (), None, frame) as (scene, _):
        for layer in scene.view_layers:
            layer.use = layer == bpy.context.view_layer
        _Taker.taken = None
        bpy.utils.register_class(_Taker)
        try:
            scene.render.engine = _Taker.bl_idname
            with as_svo_errors():
                bpy.ops.render.render()
        finally:
            bpy.utils.unregister_class(_Taker)
        if isinstance(_Taker.taken, Scene):
            return _Taker.taken
        raise _Taker.taken or SvoError(f"Blender gave no scene of '{file}'")


def compare(file: Path, folder: Path, texts: Texts, samples: int, bounces: int | None, size: Size,
            frame: int | None) -> tuple[Comparison, tuple[str, ...]]:
    """Our engine beside Cycles, and what was warned of."""
    with opened(file, texts, size, frame) as (scene, warnings):
        reference = cycles_run(scene, samples, bounces)
        return compare_runs(scene, bpy.context.view_layer, folder, svo_run(), reference), warnings()


class _Taker(bpy.types.RenderEngine):
    """Keeps what Blender prepares for a final render: no other call gives a scene as it is at render time."""

    bl_idname = "SVO_TAKER"
    bl_label = "SVO Taker"
    taken: Scene | SvoError | None = None

    def update(self, data: bpy.types.BlendData, depsgraph: bpy.types.Depsgraph) -> None:
        try:
            _Taker.taken = extract(depsgraph)
        except SvoError as error:
            _Taker.taken = error

    def render(self, depsgraph: bpy.types.Depsgraph) -> None:
        """There is nothing to do."""


@contextmanager
def opened(file: Path, texts: Texts, size: Size, frame: int | None
            ) -> Iterator[tuple[bpy.types.Scene, Callable[[], tuple[str, ...]]]]:
    """The scene of `file`, prepared, and a function that gives the warnings that Blender has reported so far."""
    checked = reduce(lambda settings, text: with_text(settings, *text), texts, RenderSettings())
    register()
    try:
        # Reports of operators go through Python's stdout
        with redirect_stdout(io.StringIO()) as reports:
            with as_svo_errors():
                bpy.ops.wm.open_mainfile(filepath=str(file.resolve()), load_ui=False)
            scene = bpy.context.scene
            if scene.camera is None:
                raise SceneError(f"Scene '{scene.name}' in '{file}' has no camera")
            for name, _ in texts:
                if name == "passes":
                    for layer in scene.view_layers:
                        ask_for(layer, checked.passes)
                else:
                    setattr(scene.svo, name, getattr(checked, name))
            if size is not None:
                scene.render.resolution_x, scene.render.resolution_y = size
                scene.render.resolution_percentage = 100
            if frame is not None:
                scene.frame_set(frame)
            yield scene, lambda: _warnings(reports.getvalue())
    finally:
        unregister()


def _warnings(reports: str) -> tuple[str, ...]:
    """Each warning once, in the order in which they came."""
    mark = "Warning: "
    return tuple(dict.fromkeys(line.removeprefix(mark) for line in reports.splitlines() if line.startswith(mark)))


def _set_format(scene: bpy.types.Scene, path: Path, is_layered: bool) -> None:
    """is_layered: whether an EXR holds all passes."""
    layered = _LAYERED if is_layered and path.suffix == ".exr" else {}
    for name, value in (_FORMATS[path.suffix] | layered).items():
        if name in scene.render.image_settings.bl_rna.properties:
            setattr(scene.render.image_settings, name, value)
