# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders by any of Blender's engines with nothing in the way of the clock: what the benchmark measures."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ..errors import SvoError
from . import session
from .cli import Size
from .cli import opened as opened_file
from .comparison import load_picture, prepared
from .host_errors import as_svo_errors
from .preserve import change
from .render_watch import render_result, seconds_of_render
from .runs import Run, cycles_run, svo_run

_GPU_KINDS = ("OPTIX", "CUDA", "HIP", "ONEAPI")
_EEVEE = ("BLENDER_EEVEE", "BLENDER_EEVEE_NEXT")  # the latter is its name in 4.2 to 4.5


@dataclass(frozen=True, eq=False)
class Rendered:
    """seconds of the whole render, picture (h, w, 3) f4, scene-linear, row 0 at the bottom; stats: of ours only."""

    seconds: float
    picture: np.ndarray
    stats: dict[str, Any] = field(default_factory=dict)


Shoot = Callable[[Mapping[str, Any]], Rendered]


@contextmanager
def opened(file: Path, size: Size) -> Iterator[bpy.types.Scene]:
    """The scene of `file` at `size` pixels, None for its own, with our engine registered. SvoError if there is none."""
    with opened_file(file, (), size, None) as (scene, _):
        yield scene


@contextmanager
def renderer(scene: bpy.types.Scene, name: str, device: str) -> Iterator[Shoot]:
    """A function that renders with `name` (rays, cones, cycles, cycles-oidn, eevee) at the settings that it is given.

    device: where Cycles renders, cpu or gpu. Blender keeps its data from render to render, whichever engine it is.
    SvoError if there is no such engine or device.
    """
    run = _run(scene, name, device)
    with prepared(scene, bpy.context.view_layer, run), ExitStack() as until_done:
        change(until_done, scene.render, use_persistent_data=True)
        with tempfile.TemporaryDirectory() as folder:
            yield lambda values: _shoot(scene, run, values, Path(folder, "picture.exr"))


def device_name(device: str) -> str:
    """What Cycles renders on."""
    if device == "cpu":
        return "CPU"
    preferences = _gpu_preferences()
    return next(str(found.name) for found in preferences.devices if found.use)


def _shoot(scene: bpy.types.Scene, run: Run, values: Mapping[str, Any], path: Path) -> Rendered:
    group = getattr(scene, run.group)
    for name, value in values.items():
        setattr(group, "taa_render_samples" if run.group == "eevee" else name, value)
    session.last_stats.clear()
    seconds = seconds_of_render(scene)
    with as_svo_errors():
        bpy.data.images[render_result()].save_render(str(path), scene=scene)
    return Rendered(seconds, load_picture(path), dict(session.last_stats))


def _run(scene: bpy.types.Scene, name: str, device: str) -> Run:
    if name in ("rays", "cones"):
        return svo_run()
    if name == "eevee":
        engines = bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items.keys()
        engine = next((known for known in _EEVEE if known in engines), _EEVEE[0])
        return Run("eevee", engine, "eevee", {"use_raytracing": True}, lambda _: {})
    if device == "gpu":
        _gpu_preferences()
    cycles = cycles_run(scene, 1)
    values = {"device": device.upper(), "use_denoising": name == "cycles-oidn", "denoiser": "OPENIMAGEDENOISE",
              "denoising_use_gpu": device == "gpu"}
    return Run(name, "CYCLES", "cycles", {**cycles.values, **values}, cycles.describe)


def _gpu_preferences() -> Any:
    """Cycles' preferences with every GPU of the first kind that there is switched on; SvoError if there is none."""
    preferences = bpy.context.preferences.addons["cycles"].preferences
    for kind in _GPU_KINDS:
        try:
            preferences.compute_device_type = kind
        except TypeError:  # this build of Blender does not know it
            continue
        preferences.refresh_devices()
        for found in preferences.devices:
            found.use = found.type == kind
        if any(found.use for found in preferences.devices):
            return preferences
    raise SvoError("Cycles finds no GPU here: leave out --device gpu")
