# SPDX-License-Identifier: GPL-3.0-or-later
"""The current frame by two engines: how far apart the pictures are, and how long each took."""

from __future__ import annotations

import json
import math
import platform
import tempfile
from collections.abc import Generator, Iterator
from contextlib import ExitStack, closing, contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from .. import __version__
from ..errors import SvoError
from ..film import encode_srgb
from ..metrics import Errors, difference_heatmap, errors
from . import session
from .host_errors import as_svo_errors
from .montage import side_by_side
from .preserve import change
from .render_watch import no_new_render_result, render_result, seconds_of_render
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


def compare(scene: bpy.types.Scene, layer: bpy.types.ViewLayer, folder: Path, ours: Run, reference: Run) -> Comparison:
    """All `steps` at once, while Blender waits. SvoError if a render fails, too; Cancelled if it is stopped."""
    with closing(steps(scene, layer, folder, ours, reference)) as todo:
        try:
            next(todo)
            while True:
                todo.send(seconds_of_render(scene))
        except StopIteration as done:
            return done.value


def steps(scene: bpy.types.Scene, layer: bpy.types.ViewLayer, folder: Path, ours: Run,
          reference: Run) -> Generator[None, float, Comparison]:
    """Render `layer` at the current frame twice, and measure: at each yield the caller makes Blender render `scene`
    and sends the seconds that it took.

    Writes an EXR of each run, comparison.png and comparison.json into `folder`, which is made if need be. When this
    ends or is closed, the scene is as it was; only the Render Result shows another picture. SvoError if there is no
    such engine or a file cannot be written.
    """
    _make_folder(folder)
    runs, found_of, images = (ours, reference), {}, []
    with no_new_render_result():
        for run in runs:
            path = folder / f"{run.name}.exr"
            with prepared(scene, layer, run):
                seconds = yield
                with as_svo_errors():
                    bpy.data.images[render_result()].save_render(str(path), scene=scene)
                found_of[run.name] = {"engine": run.engine, "picture": path.name, "seconds": seconds,
                                      **run.describe(scene)}
            images.append(load_picture(path))
    all_seconds = found_of[ours.name]["seconds"], found_of[reference.name]["seconds"]
    found = Comparison(errors(*images), all_seconds, folder / "comparison.png")
    _save(_montage(scene, runs, images, found), found.picture)
    report = {"errors": asdict(found.errors), **found_of, **_circumstances(scene, layer, images[0])}
    _write_json(report, folder / "comparison.json")
    return found


@contextmanager
def prepared(scene: bpy.types.Scene, layer: bpy.types.ViewLayer, run: Run) -> Iterator[None]:
    """All settings as `run` needs them."""
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
        yield


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


def load_picture(path: Path) -> np.ndarray:
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
