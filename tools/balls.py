# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m tools.balls`: the sample shader_balls beside Cycles, each ball by itself, written to
docs/benchmarks/shader_balls.md with a picture of both.

The reference is kept in out/shader_balls.npz, for it takes Cycles longer than all the rest, and so is the extracted
scene in out/shader_balls_scene.npz: with both a machine with a graphics card needs no Blender.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from svo_engine.film import encode_srgb
from svo_engine.metrics import bias, rel_mse
from svo_engine.render import Session
from svo_engine.scene import store
from svo_engine.scene.camera import make_view
from svo_engine.scene.types import Scene, View
from svo_engine.settings import RenderSettings

ROOT = Path(__file__).resolve().parents[1]
SAMPLE = ROOT / "sample_blends/shader_balls.blend"
KEPT = ROOT / "out/shader_balls.npz"
SCENE = ROOT / "out/shader_balls_scene.npz"
PAGE = ROOT / "docs/benchmarks/shader_balls.md"
PICTURE = ROOT / "docs/images/shader_balls.jpg"
N_BALLS = 24
LIFT, RADIUS = 0.51, 0.42  # of a ball's middle above its foot; metres

HEAD = """# Shader balls

`sample_blends/shader_balls.blend`, twenty-four node trees, at {width}x{height} and {samples} samples beside Cycles at
{reference} with its denoiser: relMSE and bias of each ball's own pixels, the noise of both included. Median
{median:.2g}; {right} of {n} at most 0.001. Ours: {device}. `python -m tools.balls` writes this page.

![Ours above, Cycles below](../images/shader_balls.jpg)

| ball | relMSE | bias |
|---|---|---|
"""


def main() -> int:
    """Render both, or one of them, and write the page."""
    parser = argparse.ArgumentParser("tools.balls", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--width", type=int, default=320, metavar="PIXELS")
    parser.add_argument("--samples", type=int, default=64, metavar="N", help="of ours")
    parser.add_argument("--reference-samples", type=int, default=256, metavar="N", help="of Cycles, if none is kept")
    parser.add_argument("--only-prepare", action="store_true", help="render the reference, extract the scene, and end")
    options = parser.parse_args()
    size = options.width, options.width * 3 // 4
    scene = _scene()
    reference = _reference(size, options.reference_samples)
    if options.only_prepare:
        return 0
    session = Session()
    assert scene.camera
    view = make_view(replace(scene.camera, size=size))
    film = list(session.films(scene, view, replace(RenderSettings(), samples=options.samples)))[-1]
    for sentence in film.stats["limits"]:
        print(sentence)
    ours = film.planes["Combined"][..., :3]
    rows = [(name, rel_mse(ours[mask][None], reference[mask][None]), bias(ours[mask][None], reference[mask][None]))
            for name, mask in _masks(scene, view)]
    _write(rows, size, options.samples, options.reference_samples, session.device_info()["renderer"])
    _save_picture(np.concatenate([reference, ours]))
    return 0


def _scene() -> Scene:
    """Extracted, or where there is no Blender the kept one."""
    if find_spec("bpy") is None:
        return store.load(SCENE)
    from svo_engine.blender.cli import extract_scene

    scene = extract_scene(SAMPLE, None)
    SCENE.parent.mkdir(exist_ok=True)
    store.save(scene, SCENE)
    return scene


def _reference(size: tuple[int, int], samples: int) -> np.ndarray:
    """(height, width, 3) f4 by Cycles, row 0 at the bottom; the kept one if it has this size."""
    if KEPT.exists() and (kept := np.load(KEPT)["picture"]).shape[1::-1] == size:
        return kept
    import bpy
    import OpenEXR

    bpy.ops.wm.open_mainfile(filepath=str(SAMPLE), load_ui=False)
    scene = bpy.context.scene
    scene.cycles.samples, scene.cycles.use_denoising, scene.render.resolution_percentage = samples, True, 100
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = f"{folder}/cycles.exr"
        bpy.ops.render.render(write_still=True)
        with OpenEXR.File(scene.render.filepath) as file:
            channels = file.channels()
            picture = np.array(channels["RGBA" if "RGBA" in channels else "RGB"].pixels[::-1, :, :3], "f4")
    KEPT.parent.mkdir(exist_ok=True)
    np.savez_compressed(KEPT, picture=picture)
    return picture


def _masks(scene: Scene, view: View) -> list[tuple[str, np.ndarray]]:
    """Name and pixels (height, width) bool of each ball, a pixel inside of its outline."""
    width, height = view.size
    y, x = np.mgrid[0:height, 0:width] + 0.5
    found: list[tuple[str, np.ndarray]] = []
    for name, matrix in zip(scene.instances.names, scene.instances.world_from_object, strict=True):
        if len(found) == N_BALLS or name in ("Floor", "Steps", "Wall"):
            continue
        middle = np.linalg.inv(view.world_from_view) @ (matrix @ (0, 0, LIFT, 1))
        clip, side = (view.clip_from_view @ p for p in (middle, middle + np.array((RADIUS, 0, 0, 0))))
        at = (clip[:2] / clip[3] + 1) / 2 * (width, height)
        radius = abs(side[0] / side[3] - clip[0] / clip[3]) / 2 * width - 1
        found.append((name, (x - at[0]) ** 2 + (y - at[1]) ** 2 < radius ** 2))
    return found


def _write(rows: Sequence[tuple[str, float, float]], size: tuple[int, int], samples: int, reference: int,
           device: str) -> None:
    errors = [error for _, error, _ in rows]
    text = HEAD.format(width=size[0], height=size[1], samples=samples, reference=reference, device=device, n=len(rows),
                       median=np.median(errors), right=sum(error <= 1e-3 for error in errors))
    text += "".join(f"| {name} | {error:.5f} | {of:+.1%} |\n" for name, error, of in rows)
    PAGE.write_text(text, encoding="utf-8")
    print(text)


def _save_picture(linear: np.ndarray) -> None:
    from PIL import Image

    PICTURE.parent.mkdir(exist_ok=True)
    Image.fromarray((encode_srgb(linear[::-1]) * 255 + 0.5).astype("u1")).save(PICTURE, quality=88)


if __name__ == "__main__":
    sys.exit(main())
