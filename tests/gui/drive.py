# SPDX-License-Identifier: GPL-3.0-or-later
"""A script that drives Blender's window as a generator: it yields seconds to wait, or a condition to wait for."""

from __future__ import annotations

import os
import subprocess
import sys
import time
import traceback
from collections.abc import Callable, Generator
from functools import partial
from pathlib import Path

import bmesh
import bpy
import gpu
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
PICTURES = ROOT / "out" / "gui"
SECONDS_TO_WAIT = 120.0
SECONDS_BETWEEN_STEPS = 0.05
Script = Generator[float | Callable[[], bool], None, None]


def start(script: Script) -> None:
    """Register the engine and run `script` from a timer, then quit; with exit code 1 as soon as anything fails."""
    sys.path.insert(0, str(ROOT))
    from svo_engine import blender

    PICTURES.mkdir(parents=True, exist_ok=True)
    bpy.context.preferences.view.show_splash = False
    blender.register()
    bpy.app.timers.register(partial(_step, script, []), first_interval=2.0, persistent=True)


def _step(script: Script, waiting: list[tuple[Callable[[], bool], float]]) -> float | None:
    """Go on to the next wait of the script. waiting: the condition in hand and its deadline, if there is one."""
    try:
        if waiting and not waiting[0][0]():
            assert time.monotonic() < waiting[0][1], "waited too long"
            return SECONDS_BETWEEN_STEPS
        waiting.clear()
        wanted = next(script)
    except StopIteration:
        bpy.ops.wm.quit_blender()
        return None
    except Exception:  # noqa: BLE001 - of any kind: the traceback is told and Blender ends
        traceback.print_exc()
        sys.stdout.flush()
        os._exit(1)
    if callable(wanted):
        waiting.append((wanted, time.monotonic() + SECONDS_TO_WAIT))
        return SECONDS_BETWEEN_STEPS
    return wanted


def window() -> bpy.types.Window:
    """The main window."""
    return bpy.context.window_manager.windows[0]


def area(kind: str = "VIEW_3D") -> bpy.types.Area:
    """The largest editor of that kind in the main window."""
    return max((a for a in window().screen.areas if a.type == kind), key=lambda a: a.width * a.height)


def in_area(place: bpy.types.Area):
    """A context for operators that need one."""
    region = next(region for region in place.regions if region.type == "WINDOW")
    return bpy.context.temp_override(window=window(), area=place, region=region)


def press(key: str) -> None:
    """A key in the foremost window: by the command in the environment variable KEYS, plus its name; else by hand."""
    if "KEYS" in os.environ:
        subprocess.run([*os.environ["KEYS"].split(), key], check=True)
    else:
        print(f"Press {key} now", flush=True)


def shot(name: str) -> np.ndarray:
    """Save what there is to see as out/gui/BACKEND-name.png. Mean colour of the 3D viewport's middle, (3,), 0 to 1.

    By Blender itself, or by the command in the environment variable SCREENSHOT, for a screen that Blender cannot read
    back: it gets the file's name and saves the whole screen.
    """
    path = PICTURES / f"{gpu.platform.backend_type_get().lower()}-{name}.png"
    if "SCREENSHOT" in os.environ:
        subprocess.run([*os.environ["SCREENSHOT"].split(), str(path)], check=True)
    else:
        with bpy.context.temp_override(window=window()):
            bpy.ops.screen.screenshot(filepath=str(path))
    color = middle(load(path), area())
    print(f"{path.name}: {color.round(3)}", flush=True)
    return color


def load(path: Path) -> np.ndarray:
    """The picture in `path`, (height, width, 3) f4, row 0 at the bottom."""
    image = bpy.data.images.load(str(path))
    pixels = np.empty(image.size[0] * image.size[1] * image.channels, "f4")
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(image.size[1], image.size[0], image.channels)[..., :3]
    bpy.data.images.remove(image)
    return pixels


def middle(pixels: np.ndarray, place: bpy.types.Area) -> np.ndarray:
    """Mean colour, (3,), of the middle ninth of an editor in a picture of the window or of the screen."""
    whole_screen = pixels.shape[1] != window().width
    x, y = (window().x, window().y) if whole_screen else (0, 0)
    x, y = x + place.x + place.width // 3, y + place.y + place.height // 3
    return pixels[y:y + place.height // 3, x:x + place.width // 3].mean((0, 1))


WALLS = (("Floor", (0.7, 0.7, 0.7), (0, 0, 0), (0, 0, 0)),
         ("Back", (0.7, 0.7, 0.7), (0, 2, 2), (90, 0, 0)),
         ("Ceiling", (0.7, 0.7, 0.7), (0, 0, 4), (180, 0, 0)),
         ("Left", (0.7, 0.05, 0.05), (-2, 0, 2), (0, 90, 0)),
         ("Right", (0.05, 0.5, 0.05), (2, 0, 2), (0, -90, 0)))


def box() -> None:
    """A room of 4 metres, open to the front, with Suzanne and a lamp, and a camera that looks in."""
    scene = bpy.context.window_manager.windows[0].scene
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    for name, color, place, turn in WALLS:
        add_mesh(name, color, place, turn, lambda mesh: bmesh.ops.create_grid(mesh, size=2))
    add_mesh("Suzanne", (0.7, 0.7, 0.7), (0, 0, 1.2), (0, 0, 0), bmesh.ops.create_monkey)
    lamp = add("Lamp", bpy.data.lights.new("Lamp", "POINT"), (0, -0.5, 3.5))
    lamp.data.energy = 200
    scene.camera = add("Camera", bpy.data.cameras.new("Camera"), (0, -8.5, 2), (90, 0, 0))
    scene.world = None
    scene.render.engine, scene.view_settings.view_transform = "SVO_ENGINE", "Standard"
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 320, 240, 100
    scene.svo.resolution, scene.svo.samples, scene.svo.viewport_samples = "64", 4, 2


def add(name, data, place, turn=(0, 0, 0)) -> bpy.types.Object:
    """A new object in the scene; `turn` in degrees."""
    thing = bpy.data.objects.new(name, data)
    thing.location, thing.rotation_euler = place, np.radians(turn)
    bpy.context.window_manager.windows[0].scene.collection.objects.link(thing)
    return thing


def add_mesh(name, color, place, turn, make) -> None:
    """A new mesh object with a rough material of its own, of that name and colour."""
    mesh, edited = bpy.data.meshes.new(name), bmesh.new()
    make(edited)
    edited.to_mesh(mesh)
    edited.free()
    material = bpy.data.materials.new(name)
    if material.node_tree is None:
        material.use_nodes = True
    surface = material.node_tree.nodes["Principled BSDF"]
    surface.inputs["Base Color"].default_value = (*color, 1)
    surface.inputs["Roughness"].default_value = 1
    mesh.materials.append(material)
    add(name, mesh, place, turn)
