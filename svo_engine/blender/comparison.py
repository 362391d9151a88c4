# SPDX-License-Identifier: GPL-3.0-or-later
"""The current frame by two engines: how far apart the pictures are, and how long each took."""

from __future__ import annotations

import json
import math
import platform
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from .. import __version__
from ..errors import Cancelled, SvoError
from ..film import encode_srgb
from ..metrics import Errors, difference_heatmap, errors
from . import session
from .host_errors import as_svo_errors
from .montage import side_by_side
from .preserve import change
from .runs import Run

# One picture, of the border alone if there is one, with nothing done to it after the render
_RENDER = {"use_crop_to_border": True, "use_multiview": False, "use_compositing": False, "use_sequencer": False,
           "use_freestyle": False, "use_stamp": False, "dither_intensity": 0.0, "use_persistent_data": False}
_FILE = {"media_type": "IMAGE", "file_format": "OPEN_EXR", "color_mode": "RGBA", "color_depth": "32",
         "exr_codec": "ZIP"}


@dataclass(frozen=True)
class Comparison:
    """What was found. seconds: (ours, reference) wall time of each render as Blender runs it, extraction included."""

    errors: Errors
    seconds: tuple[float, float]
    picture: Path

    def sentence(self) -> str:
        """All numbers in one line."""
        e, n_bad = self.errors, self.errors.n_not_finite + self.errors.n_reference_not_finite
        return (f"NRMSE {e.nrmse:.4f}, relMSE {e.rel_mse:.4f}, bias {e.bias:+.2%}, PSNR {e.psnr:.2f} dB, SSIM "
                f"{e.ssim:.4f}, {self.seconds[0]:.2f} s against {self.seconds[1]:.2f} s"
                + (f", {n_bad} pixels not finite" if n_bad else ""))


def compare(scene: bpy.types.Scene, layer: bpy.types.ViewLayer, folder: Path, ours: Run, reference: Run,
            progress: Callable[[int], None] = lambda n_done: None) -> Comparison:
    """Render `layer` at the current frame twice, blocking, and measure.

    Writes an EXR of each run, comparison.png and comparison.json into `folder`, which is made if need be. Afterwards,
    whatever happens, the scene is as it was; only the Render Result shows another picture. SvoError if a render fails
    or a file cannot be written; Cancelled by Esc.
    """
    _make_folder(folder)
    runs, found_of, images = (ours, reference), {}, []
    with _no_new_render_result():
        for n_done, run in enumerate(runs):
            progress(n_done)
            found_of[run.name] = _render(scene, layer, run, folder / f"{run.name}.exr")
            images.append(_load(folder / f"{run.name}.exr"))
        progress(len(runs))
    seconds = found_of[ours.name]["seconds"], found_of[reference.name]["seconds"]
    found = Comparison(errors(*images), seconds, folder / "comparison.png")
    _save(_montage(scene, runs, images, found), found.picture)
    report = {"errors": asdict(found.errors), **found_of, **_circumstances(scene, layer, images[0])}
    _write_json(report, folder / "comparison.json")
    return found


def _render(scene: bpy.types.Scene, layer: bpy.types.ViewLayer, run: Run, path: Path) -> dict[str, Any]:
    """Render, write the scene-linear floats to `path`, put all settings back and say what it took."""
    with ExitStack() as until_done:
        change(until_done, scene.render, **_RENDER)
        for other in scene.view_layers:
            change(until_done, other, use=other == layer)
        _write_floats(until_done, scene.render.image_settings)
        try:
            change(until_done, scene.render, engine=run.engine)
        except TypeError:
            raise SvoError(f"Blender has no render engine {run.engine}: enable its add-on") from None
        change(until_done, getattr(scene, run.group), **run.values)
        session.last_stats.clear()
        seconds = _timed_render(scene)
        with as_svo_errors():
            bpy.data.images[render_result()].save_render(str(path), scene=scene)
        return {"engine": run.engine, "picture": path.name, "seconds": seconds, **run.describe(scene)}


def _write_floats(until_done: ExitStack, image: bpy.types.ImageFormatSettings) -> None:
    """Make renders be saved as the scene-linear floats that they are.

    Blender sets the space of linear files anew with each change of the format; one that was never set, an empty name,
    cannot be given back and stays at what Blender fills in.
    """
    space = image.linear_colorspace_settings
    if space.name:
        change(until_done, space, name=space.name)
    change(until_done, image, **_FILE)
    if image.color_management == "OVERRIDE":
        space.is_data = True  # no conversion into the user's own space


def _timed_render(scene: bpy.types.Scene) -> float:
    """Seconds that Blender's render operator took; Cancelled if the user stopped it."""
    was_cancelled = []

    def notice(*_: Any) -> None:
        was_cancelled.append(True)

    bpy.app.handlers.render_cancel.append(notice)
    try:
        started = time.perf_counter()
        with as_svo_errors():
            bpy.ops.render.render(scene=scene.name)
        seconds = time.perf_counter() - started
    finally:
        bpy.app.handlers.render_cancel.remove(notice)
    if was_cancelled:
        raise Cancelled("The comparison was cancelled")
    return seconds


def render_result() -> str:
    """Name of the image that shows renders; empty before the first one."""
    return next((image.name for image in bpy.data.images if image.type == "RENDER_RESULT"), "")


@contextmanager
def _no_new_render_result() -> Iterator[None]:
    """Leave no Render Result behind where there was none."""
    had_one = bool(render_result())
    try:
        yield
    finally:
        if not had_one and (name := render_result()):
            bpy.data.images.remove(bpy.data.images[name])


def _load(path: Path) -> np.ndarray:
    """(h, w, 3) f4, scene-linear, row 0 at the bottom, of the EXR at `path`."""
    with as_svo_errors():
        image = bpy.data.images.load(str(path))
    try:
        image.colorspace_settings.is_data = True  # what was written is scene-linear already, whatever Blender guesses
        pixels = np.empty(len(image.pixels), "f4")
        image.pixels.foreach_get(pixels)
        return pixels.reshape(image.size[1], image.size[0], 4)[..., :3]
    finally:
        bpy.data.images.remove(image)


def _save(picture: np.ndarray, path: Path) -> None:
    """Write (h, w, 3) sRGB-encoded values as a PNG."""
    height, width = picture.shape[:2]
    image = bpy.data.images.new(path.name, width, height)
    try:
        image.pixels.foreach_set(np.dstack([picture, np.ones((height, width), "f4")]).ravel())
        image.filepath_raw, image.file_format = str(path), "PNG"
        with as_svo_errors():
            image.save()
    finally:
        bpy.data.images.remove(image)


def _montage(scene: bpy.types.Scene, runs: tuple[Run, Run], images: list[np.ndarray], found: Comparison) -> np.ndarray:
    """Both pictures in the view 'Standard' at the scene's exposure, and where they differ."""
    exposure = 2.0**scene.view_settings.exposure
    columns = {f"{run.name.upper()} {seconds:.2f} S": encode_srgb(np.nan_to_num(image * exposure))
               for run, seconds, image in zip(runs, found.seconds, images, strict=True)}
    return side_by_side(columns | {f"NRMSE {found.errors.nrmse:.3f}".upper(): difference_heatmap(*images)})


def _circumstances(scene: bpy.types.Scene, layer: bpy.types.ViewLayer, image: np.ndarray) -> dict[str, Any]:
    return {"file": Path(bpy.data.filepath).name, "scene": scene.name, "view_layer": layer.name,
            "frame": scene.frame_current, "size": [image.shape[1], image.shape[0]],
            "versions": {"svo_engine": __version__, "blender": bpy.app.version_string,
                         "python": platform.python_version(), "numpy": np.__version__, "system": platform.platform()}}


def _make_folder(folder: Path) -> None:
    """Make `folder` unless it is there, and see that a file can be written into it; SvoError if not."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise SvoError(f"Cannot write into the folder '{folder}': {error.strerror or error}") from error


def _write_json(report: dict[str, Any], path: Path) -> None:
    """Numbers that are not finite, which JSON does not have, become null."""
    def plain(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: plain(item) for key, item in value.items()}
        return None if isinstance(value, float) and not math.isfinite(value) else value

    try:
        path.write_text(json.dumps(plain(report), indent=2, allow_nan=False) + "\n", encoding="utf-8")
    except OSError as error:
        raise SvoError(f"Cannot write '{path}': {error.strerror or error}") from error
