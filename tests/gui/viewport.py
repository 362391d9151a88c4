# SPDX-License-Identifier: GPL-3.0-or-later
"""A RENDERED viewport draws, follows edits of lamp, material and view, splits in four, and F12 renders beside it."""

from __future__ import annotations

import sys
import threading
import time
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import drive  # type: ignore[import-not-found]  # not on the path of a type checker


def settled() -> bool:
    """Whether every RENDERED viewport has drawn all of its samples of the newest state."""
    from svo_engine.blender import viewport

    return bool(viewport._open) and all(is_drawn(v) for v in viewport._open)


def is_drawn(viewport) -> bool:
    worker = viewport._worker
    if worker.shown is None or viewport._texture is None:
        return False
    job, film = worker.shown
    return job is worker._job and film.n_samples == job.settings.samples and viewport._texture[0] is film


def settle(seconds: float = 1.0) -> drive.Script:
    """Let Blender notice a change, and wait until it is drawn."""
    yield seconds
    yield settled
    yield seconds


def workers() -> int:
    """How many viewports' threads there are."""
    return sum(thread.name == "SVO viewport" for thread in threading.enumerate())


def show(kind: str) -> None:
    drive.area().spaces.active.shading.type = kind


def edits() -> drive.Script:
    space, scene = drive.area().spaces.active, drive.window().scene
    space.region_3d.view_perspective = "CAMERA"
    space.overlay.show_overlays = False
    show("RENDERED")
    yield from settle()
    start = drive.shot("start")
    assert start.max() > 0.05, "the viewport is black"

    bpy.data.lights["Lamp"].color = (1, 0.1, 0.1)
    yield from settle()
    lit = drive.shot("red-lamp")
    assert lit[0] / lit[1] > 1.5 * start[0] / start[1], "the lamp's colour is not followed"

    bpy.data.lights["Lamp"].color = (1, 1, 1)
    bpy.data.materials["Suzanne"].node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0, 0, 0.8, 1)
    yield from settle()
    painted = drive.shot("blue-suzanne")
    assert painted[2] / painted[0] > 1.1 * start[2] / start[0], "the material is not followed"

    bpy.data.objects["Suzanne"].location.x = 1
    yield from settle()
    drive.shot("moved")

    scene.render.use_border = True
    scene.render.border_min_x, scene.render.border_max_x = 0.25, 0.75
    yield from settle()
    drive.shot("camera-border")
    scene.render.use_border = False

    space.region_3d.view_perspective = "PERSP"
    space.overlay.show_overlays = True
    space.region_3d.view_distance = 18
    yield from settle()
    drive.shot("perspective")
    with drive.in_area(drive.area()):
        bpy.ops.view3d.view_axis(type="TOP")
    yield from settle(2.0)
    drive.shot("top-orthographic")
    scene.render.film_transparent = True
    yield from settle()
    drive.shot("transparent")
    scene.render.film_transparent = False


def switching() -> drive.Script:
    show("SOLID")
    yield lambda: workers() == 0
    show("RENDERED")
    yield from settle()
    with drive.in_area(drive.area()):
        bpy.ops.screen.region_quadview()
    yield from settle(2.0)
    assert workers() == 4
    drive.shot("quad")
    with drive.in_area(drive.area()):
        bpy.ops.screen.region_quadview()
    yield lambda: workers() == 1
    with drive.in_area(drive.area()):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.5)
    yield from settle()
    drive.shot("split")
    drive.window().scene.svo.view = "voxel_radiance"
    yield from settle()
    drive.shot("voxels")
    drive.window().scene.svo.view = "combined"


def lifetimes() -> drive.Script:
    """The viewport outlives its file and the extension."""
    from svo_engine import blender

    path = drive.PICTURES / "saved.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.open_mainfile(filepath=str(path))
    yield lambda: workers() == 0
    show("RENDERED")  # Blender opens no file like that
    yield from settle(2.0)
    assert workers() == 1
    drive.shot("reopened")

    blender.unregister()
    yield 1.0
    assert workers() == 0
    blender.register()
    show("SOLID")
    yield 1.0
    show("RENDERED")
    yield from settle()
    drive.shot("registered-again")


def final() -> drive.Script:
    from svo_engine.blender import session

    ended = []
    bpy.app.handlers.render_complete.append(lambda *_: ended.append("complete"))
    bpy.app.handlers.render_cancel.append(lambda *_: ended.append("cancel"))
    with bpy.context.temp_override(window=drive.window()):
        bpy.ops.render.render("INVOKE_DEFAULT")
    yield lambda: bool(ended)
    yield 2.0
    assert ended == ["complete"]
    assert session.last_stats["n_samples"] == 4
    print("F12:", session.last_stats, flush=True)
    drive.shot("f12")

    ended.clear()
    drive.window().scene.svo.samples = 65536
    with bpy.context.temp_override(window=drive.window()):
        bpy.ops.render.render("INVOKE_DEFAULT")
    yield 4.0
    pressed = time.monotonic()
    drive.press("Escape")
    yield lambda: bool(ended)
    print(f"Esc: {ended} after {time.monotonic() - pressed:.2f} s", flush=True)
    assert ended == ["cancel"]


def script() -> drive.Script:
    drive.box()
    yield 1.0
    yield from edits()
    yield from switching()
    yield from lifetimes()
    yield from final()
    # Blender quits from here with a RENDERED viewport open


drive.start(script())
